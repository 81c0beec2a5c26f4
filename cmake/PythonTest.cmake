# SPDX-License-Identifier: GPL-2.0-or-later
# What Python needs to find of ours: the package, the programs, and a place for its bytecode.
set(MAGFSI_PYTHON_ENVIRONMENT PYTHONPATH=${PROJECT_SOURCE_DIR}/adapters/python
  PYTHONPYCACHEPREFIX=${CMAKE_BINARY_DIR}/pycache MAGFSI_BIN=${CMAKE_RUNTIME_OUTPUT_DIRECTORY})

# magfsi_python_test(NAME SCRIPT ... LABELS ... [TIMEOUT s] [COST s] [SERIAL] [ARGUMENTS ...]
#                    [SMALL ...]):
# a Python script (standard library only) that runs the built programs. It counts as one core:
# of the two sides of a run one waits, asleep. The dear ones, by COST, start first. SMALL: the
# arguments with which the script is the small case of the same claim, NAME_small, of the tier short.
function(magfsi_python_test name)
  cmake_parse_arguments(arg "SERIAL" "SCRIPT;TIMEOUT;COST" "LABELS;ARGUMENTS;SMALL" ${ARGN})
  if(arg_SMALL)
    set(serial)
    if(arg_SERIAL)
      set(serial SERIAL)
    endif()
    magfsi_python_test(${name}_small SCRIPT ${arg_SCRIPT} LABELS short ${serial} ARGUMENTS ${arg_SMALL})
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 900)
  endif()
  if(NOT arg_COST)
    set(arg_COST 5)
  endif()
  add_test(NAME ${name} COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/${arg_SCRIPT}
           ${arg_ARGUMENTS})
  set_tests_properties(${name} PROPERTIES
    LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT} COST ${arg_COST}
    RUN_SERIAL $<BOOL:${arg_SERIAL}>)
  magfsi_mpi_environment(${name} ${MAGFSI_PYTHON_ENVIRONMENT})
endfunction()
