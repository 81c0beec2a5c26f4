# SPDX-License-Identifier: GPL-2.0-or-later
# The fluid by our own lattice Boltzmann solver.
add_library(magfsi_lbm_scene STATIC
  solvers/lbm/explain.cpp
  solvers/lbm/lattice_values.cpp
  solvers/lbm/scene_to_fluid.cpp)
target_link_libraries(magfsi_lbm_scene
  PUBLIC magfsi_scene magfsi_fluid PRIVATE magfsi_bodies fmt::fmt)
target_link_libraries(magfsi_fluid_solvers INTERFACE magfsi_lbm_scene)

add_library(magfsi_lbm_participant STATIC
  solvers/lbm/fluid_state.cpp
  solvers/lbm/lbm_fluid.cpp
  solvers/lbm/refined_lbm.cpp)
target_link_libraries(magfsi_lbm_participant
  PUBLIC magfsi_fluid_participant magfsi_lbm_scene PRIVATE fmt::fmt)

add_executable(magfsi-fluid-lbm solvers/lbm/main.cpp)
target_link_libraries(magfsi-fluid-lbm PRIVATE magfsi_lbm_participant)
set_property(GLOBAL APPEND PROPERTY MAGFSI_FLUID_PROGRAMS magfsi-fluid-lbm)
magfsi_precompiled(magfsi_lbm_scene magfsi_lbm_participant)
