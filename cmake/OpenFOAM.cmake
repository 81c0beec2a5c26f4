# SPDX-License-Identifier: GPL-2.0-or-later
# The second fluid, fluid.solver: openfoam, is there when Debian's OpenFOAM libraries and the
# headers of its source package are. MAGFSI_OPENFOAM says so.
set(MAGFSI_OPENFOAM_FOLDER ${PROJECT_SOURCE_DIR}/build/openfoam CACHE PATH
  "Where cmake/openfoam_headers.sh has put OpenFOAM's headers")
find_library(OPENFOAM_LIBRARY OpenFOAM)
set(MAGFSI_OPENFOAM ON)
set(missing)
if(MAGFSI_SANITIZE)
  set(missing "a build without sanitizers, which would find OpenFOAM's own leaks")
elseif(NOT OPENFOAM_LIBRARY)
  set(missing "its libraries (apt-get install openfoam)")
elseif(NOT EXISTS ${MAGFSI_OPENFOAM_FOLDER}/version)
  set(missing "its headers (cmake/openfoam_headers.sh ${MAGFSI_OPENFOAM_FOLDER})")
endif()
if(missing)
  set(MAGFSI_OPENFOAM OFF)
  message(STATUS "OpenFOAM: no; missing ${missing}; then configure again")
  return()
endif()
file(STRINGS ${MAGFSI_OPENFOAM_FOLDER}/version openfoam_version LIMIT_COUNT 1)
message(STATUS "OpenFOAM: ${openfoam_version}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${MAGFSI_OPENFOAM_FOLDER}/version)

# The libraries that stock pimpleFoam is linked to, as far as a fixed mesh needs them. They
# have no SONAME: by -l, so that the loader looks for the bare name.
file(GLOB openfoam_headers LIST_DIRECTORIES ON ${MAGFSI_OPENFOAM_FOLDER}/include/*)
get_filename_component(openfoam_library_folder ${OPENFOAM_LIBRARY} DIRECTORY)
add_library(magfsi_openfoam_headers INTERFACE)
target_include_directories(magfsi_openfoam_headers SYSTEM INTERFACE ${openfoam_headers})
target_compile_definitions(magfsi_openfoam_headers INTERFACE
  WM_DP WM_LABEL_SIZE=32 NoRepository)
target_compile_features(magfsi_openfoam_headers INTERFACE cxx_std_17)
target_link_directories(magfsi_openfoam_headers INTERFACE ${openfoam_library_folder})
target_link_libraries(magfsi_openfoam_headers INTERFACE
  -lincompressibleTurbulenceModels -lturbulenceModels -lincompressibleTransportModels
  -lfvOptions -lfiniteVolume -lmeshTools -lOpenFOAM -lPstream)
