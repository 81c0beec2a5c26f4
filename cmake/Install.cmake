# SPDX-License-Identifier: GPL-2.0-or-later
# cmake --install: GNU layout, relocatable: every program finds what it needs relative to itself.
#   bin/magfsi                    the launcher
#   libexec/magfsi/{bin,lib}      the programs that it starts, the library of OpenFOAM's solver
#   share/magfsi/                 tutorials, schema, completions, examples
#   lib/python3/dist-packages/    the package magfsi (MAGFSI_PYTHON_DIR)
#   include/magfsi, lib/          headers and libraries; lib/cmake/magfsi for find_package(magfsi)
# Components: runtime, openfoam, dev; each is a Debian package (Package.cmake).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(MAGFSI_PYTHON_DIR lib/python3/dist-packages CACHE STRING
  "Where the Python package goes, below the prefix")
set(magfsi_home ${CMAKE_INSTALL_LIBEXECDIR}/magfsi)
set(magfsi_share ${CMAKE_INSTALL_DATADIR}/magfsi)
set(magfsi_generated ${CMAKE_BINARY_DIR}/install)

# --- programs, and what they read ---
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
install(TARGETS ${programs} RUNTIME DESTINATION ${magfsi_home}/bin)
if(TARGET magfsi_openfoam_engine)
  install(TARGETS magfsi_openfoam_engine LIBRARY DESTINATION ${magfsi_home}/lib
    COMPONENT openfoam)
endif()
if(TARGET magfsi_openfoam_digest)
  install(TARGETS magfsi_openfoam_digest LIBRARY DESTINATION ${magfsi_home}/lib
    COMPONENT openfoam)
endif()

add_custom_command(OUTPUT ${magfsi_generated}/scene.schema.json
  COMMAND ${CMAKE_COMMAND} -E make_directory ${magfsi_generated}
  COMMAND magfsi schema > ${magfsi_generated}/scene.schema.json DEPENDS magfsi)
add_custom_target(magfsi_schema ALL DEPENDS ${magfsi_generated}/scene.schema.json)
add_dependencies(programs magfsi_schema)
install(FILES ${magfsi_generated}/scene.schema.json DESTINATION ${magfsi_share})

install(DIRECTORY tutorials DESTINATION ${magfsi_share})
install(DIRECTORY docs/examples DESTINATION ${magfsi_share})
install(FILES adapters/app/launcher/commands.bash adapters/app/launcher/completion.bash
  adapters/app/launcher/completion.zsh DESTINATION ${magfsi_share}/launcher)
install(FILES adapters/app/launcher/completion.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME magfsi)
install(FILES adapters/app/launcher/completion.zsh
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _magfsi)
install(FILES README.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES CITATION.cff DESTINATION ${magfsi_share})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
configure_file(cmake/install/magfsi.in ${magfsi_generated}/magfsi @ONLY)
install(PROGRAMS ${magfsi_generated}/magfsi DESTINATION ${CMAKE_INSTALL_BINDIR})

install(DIRECTORY adapters/python/magfsi DESTINATION ${MAGFSI_PYTHON_DIR}
  PATTERN __pycache__ EXCLUDE)
foreach(place share home)
  file(RELATIVE_PATH to_${place} /prefix/${MAGFSI_PYTHON_DIR}/magfsi /prefix/${magfsi_${place}})
endforeach()
configure_file(cmake/install/place.py.in ${magfsi_generated}/place.py @ONLY)
install(FILES ${magfsi_generated}/place.py DESTINATION ${MAGFSI_PYTHON_DIR}/magfsi)

# --- for programs in C++ ---
# Their names there: magfsi::coupler has the scene and the coupled run, magfsi::lammps the styles.
set(exported
  magfsi_options:options magfsi_isa:isa magfsi_surface:surface magfsi_fluid:lbm magfsi_tables:tables
  magfsi_structure:structure
  magfsi_structure_lammps:lammps magfsi_coupler:coupler_core magfsi_scene:scene
  magfsi_run_scene:run_scene
  magfsi_structure_program:coupler)
foreach(pair ${exported})
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 target)
  list(GET pair 1 name)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT magfsi ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    COMPONENT dev)
endforeach()
install(EXPORT magfsi NAMESPACE magfsi:: FILE magfsi-targets.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/magfsi COMPONENT dev)
foreach(folder coupler structure fluid_lbm adapters/scene)
  get_filename_component(above ${folder} DIRECTORY)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/magfsi/${above}
    COMPONENT dev FILES_MATCHING PATTERN "*.h")
endforeach()
# The kinds of boundaries, which options.h reads.
install(FILES fluid_lbm/effects.inc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/magfsi/fluid_lbm
  COMPONENT dev)
install(FILES adapters/run_scene.h adapters/structure_program.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/magfsi/adapters
  COMPONENT dev)
install(DIRECTORY base
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/magfsi COMPONENT dev FILES_MATCHING PATTERN "*.h")
configure_package_config_file(cmake/install/magfsi-config.cmake.in
  ${magfsi_generated}/magfsi-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/magfsi
  PATH_VARS CMAKE_INSTALL_INCLUDEDIR magfsi_home)
write_basic_package_version_file(${magfsi_generated}/magfsi-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${magfsi_generated}/magfsi-config.cmake
  ${magfsi_generated}/magfsi-config-version.cmake cmake/Dependencies.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/magfsi COMPONENT dev)
