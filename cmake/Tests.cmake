# SPDX-License-Identifier: GPL-2.0-or-later
# What every test run needs under Open MPI 4: root in containers, more ranks than cores, and
# waiting ranks that give their core away.
set(MAGFSI_MPI_ENVIRONMENT
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
  OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_base_warn_component_unused=0
  OMPI_MCA_pml=ob1 OMP_NUM_THREADS=1
  # The same in the words of Open MPI 5, and round its crash at jobs of several programs
  # (adapters/app/mpirun.cpp).
  PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
  PRTE_MCA_hwloc_default_binding_policy=none PMIX_MCA_pmdl=^ompi)

# Environment of one test, with a folder of its own for the files of mpirun
# (adapters/app/mpirun_guard.h), then what else is given.
function(magfsi_mpi_environment test)
  set_property(TEST ${test} PROPERTY ENVIRONMENT ${MAGFSI_MPI_ENVIRONMENT}
    OMPI_MCA_orte_tmpdir_base=${CMAKE_BINARY_DIR}/mpi/${test} ${ARGN})
endfunction()

# Test programs are compiled with -O1: a third less time to build, and the code under test is
# optimised all the same.
set(MAGFSI_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)

# GoogleTest's headers beside those of Precompiled.cmake.
add_library(magfsi_precompiled_tests OBJECT ${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp)
target_link_libraries(magfsi_precompiled_tests PRIVATE
  magfsi_options Eigen3::Eigen fmt::fmt GTest::gtest)
# GCC 14 refuses a precompiled header of another optimisation.
target_compile_options(magfsi_precompiled_tests PRIVATE ${MAGFSI_TEST_OPTIONS})
target_precompile_headers(magfsi_precompiled_tests PRIVATE
  ${MAGFSI_COMMON_HEADERS} <gtest/gtest.h>)

function(magfsi_test_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  # Eigen's and fmt's headers are in the precompiled one.
  target_link_libraries(${name} PRIVATE magfsi_options ${arg_LIBRARIES} Eigen3::Eigen fmt::fmt)
  target_compile_options(${name} PRIVATE ${MAGFSI_TEST_OPTIONS})
  if(NOT "OpenMP::OpenMP_CXX" IN_LIST arg_LIBRARIES)  # which sets macros of its own
    # GCC 12's false alarms at std::string (its bug 105651).
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
      $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
      $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
    target_precompile_headers(${name} REUSE_FROM magfsi_precompiled_tests)
  endif()
endfunction()

# Every test has one of the labels quick (three minutes in all), short (with quick: what
# `./magfsi test` runs in ten), all (`--all`), long (`--long`).

# magfsi_unit_test(NAME SOURCES ... LIBRARIES ... [LABELS ...] [SMALL FILTER]): one GoogleTest
# program, one CTest. The label is quick unless given. SMALL: GoogleTest's filter for the small
# case of the same claims, NAME_small, of the tier short.
function(magfsi_unit_test name)
  cmake_parse_arguments(arg "" "SMALL" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT arg_LABELS)
    set(arg_LABELS quick)
  endif()
  magfsi_test_program(${name}
    SOURCES ${arg_SOURCES} LIBRARIES ${arg_LIBRARIES} GTest::gtest_main)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 900)
  magfsi_mpi_environment(${name})
  if(arg_SMALL)
    add_test(NAME ${name}_small COMMAND ${name} --gtest_filter=${arg_SMALL})
    set_tests_properties(${name}_small PROPERTIES LABELS short TIMEOUT 300)
    magfsi_mpi_environment(${name}_small)
  endif()
endfunction()

# magfsi_mpi_test(NAME RANKS 1 2 ... SOURCES ... LIBRARIES ... [LABELS ...] [PARTS ...]
#                 [SMALL FILTER]): the
# same program as one CTest for each number of ranks, and for each test suite in PARTS.
# Assertions count on every rank. SMALL: as above, on the first number of ranks. ALSO_ON 3 4: numbers
# of ranks of the tier all.
function(magfsi_mpi_test name)
  cmake_parse_arguments(arg "" "SMALL" "RANKS;ALSO_ON;SOURCES;LIBRARIES;LABELS;PARTS" ${ARGN})
  if(NOT arg_LABELS)
    set(arg_LABELS quick)
  endif()
  magfsi_test_program(${name}
    SOURCES ${arg_SOURCES} LIBRARIES ${arg_LIBRARIES} magfsi_mpi_main)
  if(NOT arg_PARTS)
    set(arg_PARTS "*")
  endif()
  foreach(ranks ${arg_RANKS} ${arg_ALSO_ON})
    if(ranks IN_LIST arg_ALSO_ON)
      set(arg_LABELS all)
    endif()
    set(cores 2)
    if(ranks EQUAL 1)
      set(cores 1)
    endif()
    foreach(part ${arg_PARTS})
      set(test ${name}_${ranks})
      if(NOT part STREQUAL "*")
        set(test ${name}_${part}_${ranks})
      endif()
      add_test(NAME ${test} COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:${name}>
        --gtest_filter=${part}.*)
      set_tests_properties(${test} PROPERTIES
        LABELS "${arg_LABELS}" TIMEOUT 900 PROCESSORS ${cores})
      magfsi_mpi_environment(${test})
    endforeach()
  endforeach()
  if(arg_SMALL)
    list(GET arg_RANKS 0 ranks)
    add_test(NAME ${name}_small COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:${name}>
      --gtest_filter=${arg_SMALL})
    set_tests_properties(${name}_small PROPERTIES LABELS short TIMEOUT 300)
    magfsi_mpi_environment(${name}_small)
  endif()
endfunction()
