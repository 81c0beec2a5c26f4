# SPDX-License-Identifier: GPL-2.0-or-later
# A generated script with a run command appended works with the plain executable.
#   cmake -DWRITER=... -DLAMMPS=... -DFOLDER=... -P plain_script.cmake
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${WRITER} ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
file(APPEND ${FOLDER}/lammps.in "run 100\nwrite_dump all custom ${FOLDER}/end.txt id z\n")
execute_process(COMMAND ${LAMMPS} -in lammps.in -log none -nocite
  WORKING_DIRECTORY ${FOLDER} OUTPUT_VARIABLE said RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR NOT EXISTS ${FOLDER}/end.txt)
  message(FATAL_ERROR "magfsi-lammps ended with ${code}:\n${said}")
endif()
# The same script with an unknown keyword must not pass as a good one.
file(APPEND ${FOLDER}/lammps.in "fix bad all magttice nothing 1 1 1 elements full\n")
execute_process(COMMAND ${LAMMPS} -in lammps.in -log none -nocite
  WORKING_DIRECTORY ${FOLDER} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
if(code EQUAL 0 OR NOT said MATCHES "\"elements\" found")
  message(FATAL_ERROR "a bad keyword ended with ${code}:\n${said}")
endif()
