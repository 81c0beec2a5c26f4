# SPDX-License-Identifier: GPL-2.0-or-later
# Runs the converter as a user does: what it reports, what it writes, how it refuses.
execute_process(COMMAND ${CONVERTER} ${INPUT} ${FOLDER}/two_cubes.mesh --unit 0.001
  OUTPUT_VARIABLE report RESULT_VARIABLE code)
foreach(line "2 hexahedra, 12 nodes" "region rubber: 2 elements" "face held: 4 nodes")
  if(NOT code EQUAL 0 OR NOT report MATCHES "${line}")
    message(FATAL_ERROR "exit code ${code}, no \"${line}\" in: ${report}")
  endif()
endforeach()
file(READ ${FOLDER}/two_cubes.mesh text)
if(NOT text MATCHES "nodes 12\n.*\n0.002 0.001 0.001\nregions 1\nrubber\nelements 2\n")
  message(FATAL_ERROR "the mesh file holds: ${text}")
endif()

execute_process(COMMAND ${CONVERTER} ${FOLDER}/two_cubes.mesh ${FOLDER}/again.mesh
  ERROR_VARIABLE error RESULT_VARIABLE code)
if(NOT code EQUAL 2 OR NOT error MATCHES "two_cubes.mesh: the file does not begin with")
  message(FATAL_ERROR "exit code ${code}, error: ${error}")
endif()
