find_package(GTest REQUIRED)

# What every test run needs under Open MPI: root in containers, more ranks than cores, and
# waiting ranks that give their core away.
set(MAGFSI_MPI_ENVIRONMENT
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
  OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_base_warn_component_unused=0
  OMP_NUM_THREADS=1)

# Test programs are compiled with -O1: a third less time to build, and the code under test is
# optimised all the same.
set(MAGFSI_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)

# magfsi_unit_test(NAME SOURCES ... LIBRARIES ... [LABELS ...]): one GoogleTest program, one
# CTest. The label is quick unless given.
function(magfsi_unit_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT arg_LABELS)
    set(arg_LABELS quick)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE magfsi_options ${arg_LIBRARIES} GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${MAGFSI_TEST_OPTIONS})
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 900)
  set_property(TEST ${name} PROPERTY ENVIRONMENT ${MAGFSI_MPI_ENVIRONMENT})
endfunction()

# magfsi_mpi_test(NAME RANKS 1 2 ... SOURCES ... LIBRARIES ... [LABELS ...]): the same program
# as one CTest for each number of ranks. Assertions count on every rank.
function(magfsi_mpi_test name)
  cmake_parse_arguments(arg "" "" "RANKS;SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT arg_LABELS)
    set(arg_LABELS quick)
  endif()
  add_executable(${name} ${arg_SOURCES} ${PROJECT_SOURCE_DIR}/tests/mpi/mpi_main.cpp)
  target_link_libraries(${name} PRIVATE magfsi_options ${arg_LIBRARIES} GTest::gtest MPI::MPI_CXX)
  target_compile_options(${name} PRIVATE ${MAGFSI_TEST_OPTIONS})
  foreach(ranks ${arg_RANKS})
    add_test(NAME ${name}_${ranks} COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:${name}>)
    set_tests_properties(${name}_${ranks} PROPERTIES
      LABELS "${arg_LABELS}" TIMEOUT 900 PROCESSORS 2)
    set_property(TEST ${name}_${ranks} PROPERTY ENVIRONMENT ${MAGFSI_MPI_ENVIRONMENT})
  endforeach()
endfunction()
