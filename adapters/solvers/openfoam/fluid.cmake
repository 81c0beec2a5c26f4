# SPDX-License-Identifier: GPL-2.0-or-later
# The fluid by OpenFOAM: a program that is always there, and the library of its solver, which
# sees OpenFOAM's headers and is loaded when the scene wants it.
add_library(magfsi_openfoam_scene STATIC
  solvers/openfoam/engine_library.cpp
  solvers/openfoam/explain.cpp
  solvers/openfoam/inlet.cpp
  solvers/openfoam/mesh.cpp
  solvers/openfoam/obstacles.cpp
  solvers/openfoam/user_files.cpp)
target_link_libraries(magfsi_openfoam_scene
  PUBLIC magfsi_run_scene PRIVATE magfsi_fluid fmt::fmt ${CMAKE_DL_LIBS})
target_link_libraries(magfsi_fluid_solvers INTERFACE magfsi_openfoam_scene)

add_library(magfsi_openfoam_participant STATIC
  solvers/openfoam/block_mesh.cpp
  solvers/openfoam/case.cpp
  solvers/openfoam/flow.cpp
  solvers/openfoam/foam_fluid.cpp
  solvers/openfoam/mesh_programs.cpp
  solvers/openfoam/world_of_openfoam.cpp)
target_link_libraries(magfsi_openfoam_participant
  PUBLIC magfsi_fluid_participant magfsi_openfoam_scene PRIVATE magfsi_fluid fmt::fmt)

# ENABLE_EXPORTS: OpenFOAM finds our MPI functions before MPI's.
add_executable(magfsi-fluid-openfoam solvers/openfoam/main.cpp)
set_target_properties(magfsi-fluid-openfoam PROPERTIES ENABLE_EXPORTS ON)
target_link_libraries(magfsi-fluid-openfoam PRIVATE magfsi_openfoam_participant)
set_property(GLOBAL APPEND PROPERTY MAGFSI_FLUID_PROGRAMS magfsi-fluid-openfoam)

if(MAGFSI_OPENFOAM)
  add_library(magfsi_openfoam_engine MODULE
    solvers/openfoam/engine/box_mesh.cpp
    solvers/openfoam/engine/coupled_force.cpp
    solvers/openfoam/engine/pimple_engine.cpp
    solvers/openfoam/engine/plane.cpp)
  set_target_properties(magfsi_openfoam_engine PROPERTIES
    CXX_STANDARD 17 LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
  target_link_libraries(magfsi_openfoam_engine PRIVATE magfsi_options magfsi_openfoam_headers)
  add_dependencies(magfsi-fluid-openfoam magfsi_openfoam_engine)
  magfsi_cold(magfsi_openfoam_engine)  # the work is in OpenFOAM's libraries
  # For stock programs (magfsi witness), which load it by LD_PRELOAD.
  file(STRINGS ${MAGFSI_OPENFOAM_FOLDER}/include/OpenFOAM/OSHA1stream.H overflow REGEX overflow)
  if(NOT overflow)
    add_library(magfsi_openfoam_digest MODULE solvers/openfoam/engine/digest_stream.cpp)
    set_target_properties(magfsi_openfoam_digest PROPERTIES
      CXX_STANDARD 17 LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
    target_include_directories(magfsi_openfoam_digest SYSTEM PRIVATE ${openfoam_headers})
    target_compile_definitions(magfsi_openfoam_digest PRIVATE
      WM_DP WM_LABEL_SIZE=32 NoRepository)
    add_dependencies(magfsi-fluid-openfoam magfsi_openfoam_digest)
    # Found in the engine before OpenFOAM's, for the scene's own function objects.
    target_sources(magfsi_openfoam_engine PRIVATE solvers/openfoam/engine/digest_stream.cpp)
    set_source_files_properties(solvers/openfoam/engine/digest_stream.cpp PROPERTIES
      SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endif()
magfsi_cold(magfsi_openfoam_scene magfsi_openfoam_participant magfsi-fluid-openfoam)
