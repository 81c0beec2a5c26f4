# SPDX-License-Identifier: GPL-2.0-or-later
# The preset release compiles several sources of a target at once (CMAKE_UNITY_BUILD), which takes a
# quarter less time. They then share their unnamed namespaces; the other presets compile file by file.
#
# magfsi_compiled_alone(TARGET ...): these of a target's sources stay object files of their own: effects
# and outputs with what is theirs alone, so that a program can be linked without them
# (tests/effects/removed.py), and what a program in docs/examples replaces by its own.
set(magfsi_alone "(^|/)(effects|outputs)/" mesh/proximity bodies/overlaps bodies/solids_around
  bodies/structure_files checkpoint/checkpoints lammps/effects)
list(JOIN magfsi_alone "|" magfsi_alone)

function(magfsi_compiled_alone)
  foreach(target ${ARGN})
    get_target_property(folder ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
      get_filename_component(source "${source}" ABSOLUTE BASE_DIR ${folder})
      if(source MATCHES "(${magfsi_alone})")
        set_source_files_properties(${source} TARGET_DIRECTORY ${target}
          PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endforeach()
endfunction()

if(CMAKE_UNITY_BUILD)  # GCC takes the unnamed namespaces of included files for a header's
  target_compile_options(magfsi_options INTERFACE $<BUILD_INTERFACE:-Wno-subobject-linkage>)
endif()
