# SPDX-License-Identifier: GPL-2.0-or-later
# Libraries of others, each by what it is for; on Debian each is one line of packages.txt. The build
# asks for all parts; an installation (magfsi-config.cmake), which has a copy of this file, for those
# that its user names. What is not found is gathered in magfsi_missing, so that it is said at once.
set(magfsi_missing "")

macro(magfsi_missing_is purpose debian)
  list(APPEND magfsi_missing "${purpose} (Debian: ${debian})")
  list(REMOVE_DUPLICATES magfsi_missing)
endmacro()

# magfsi_package(PURPOSE DEBIAN NAME ...): one with a CMake package.
macro(magfsi_package purpose debian name)
  find_package(${name} QUIET ${ARGN})
  if(NOT ${name}_FOUND)
    magfsi_missing_is("${purpose}" ${debian})
  endif()
endmacro()

# magfsi_library(PURPOSE DEBIAN TARGET PREFIX HEADER FOLDER LIBRARY ...): one without; FOLDER below
# the include paths, LIBRARY its possible names.
macro(magfsi_library purpose debian target prefix header folder)
  find_path(${prefix}_INCLUDE_DIR ${header} PATH_SUFFIXES ${folder})
  find_library(${prefix}_LIBRARY NAMES ${ARGN})
  if(NOT ${prefix}_INCLUDE_DIR OR NOT ${prefix}_LIBRARY)
    magfsi_missing_is("${purpose}" ${debian})
  elseif(NOT TARGET ${target})
    add_library(${target} UNKNOWN IMPORTED)
    set_target_properties(${target} PROPERTIES IMPORTED_LOCATION ${${prefix}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${${prefix}_INCLUDE_DIR})
  endif()
endmacro()

macro(magfsi_find_lbm)
  magfsi_package("OpenMP, for the fluid's threads" g++ OpenMP COMPONENTS CXX)
endmacro()

macro(magfsi_find_formulas)
  magfsi_package("muParser, which reads formulas" libmuparser-dev muparser)
endmacro()

macro(magfsi_find_coupler)
  magfsi_package("yaml-cpp, which reads scenes" libyaml-cpp-dev yaml-cpp)
  if(TARGET yaml-cpp AND NOT TARGET yaml-cpp::yaml-cpp)  # before 0.8 it exports the bare name
    add_library(yaml-cpp::yaml-cpp INTERFACE IMPORTED)
    set_target_properties(yaml-cpp::yaml-cpp PROPERTIES INTERFACE_LINK_LIBRARIES yaml-cpp)
  endif()
  magfsi_find_formulas()
  magfsi_package("CLI11, which reads command lines" libcli11-dev CLI11)
  magfsi_package("spdlog, for the log" libspdlog-dev spdlog)
  magfsi_package("JSON for Modern C++, for summaries" nlohmann-json3-dev nlohmann_json)
  # The serial library: one rank of a participant writes, so that the file does not depend on
  # how many there are.
  magfsi_library("HDF5, for checkpoints" libhdf5-dev hdf5::hdf5 HDF5 hdf5.h hdf5/serial
    hdf5_serial hdf5)
endmacro()

macro(magfsi_find_structure)
  magfsi_find_formulas()
  # With OpenMP inside. Its time is spent in BLAS: packages.txt names OpenBLAS, several times as
  # fast as the reference library, in its serial variant, which starts no threads of its own.
  magfsi_library("CHOLMOD, which factorises Newton's tangent" libsuitesparse-dev cholmod::cholmod
    CHOLMOD cholmod.h suitesparse cholmod)
  if(TARGET cholmod::cholmod)
    set_target_properties(cholmod::cholmod PROPERTIES INTERFACE_LINK_LIBRARIES gomp)
  endif()
endmacro()

macro(magfsi_find_gmsh)
  magfsi_library("Gmsh's library, which reads meshes" libgmsh-dev gmsh::gmsh GMSH gmsh.h "" gmsh)
endmacro()

# The unmodified LAMMPS library. versions: the path of structure/lammps/lammps_versions.h.
macro(magfsi_find_lammps versions)
  magfsi_library("the LAMMPS library with its headers, which moves the bodies" liblammps-dev
    lammps::lammps LAMMPS lammps/lammps.h "" lammps)
  if(TARGET lammps::lammps AND NOT TARGET magfsi_lammps_headers)
    add_library(magfsi_lammps_headers INTERFACE IMPORTED)
    target_include_directories(magfsi_lammps_headers SYSTEM BEFORE INTERFACE
      ${LAMMPS_INCLUDE_DIR}/lammps)
    # A target with MAGFSI_LAMMPS_PRECOMPILED has that header in its precompiled one.
    target_compile_options(magfsi_lammps_headers INTERFACE
      "SHELL:$<$<NOT:$<BOOL:$<TARGET_PROPERTY:MAGFSI_LAMMPS_PRECOMPILED>>>:-include ${versions}>")
    target_compile_definitions(magfsi_lammps_headers INTERFACE LAMMPS_SMALLBIG)
    target_link_libraries(magfsi_lammps_headers INTERFACE ${LAMMPS_LIBRARY} MPI::MPI_CXX)
  endif()
endmacro()

# What every part takes.
macro(magfsi_find_common)
  magfsi_package("MPI, which joins the solvers" libopenmpi-dev MPI COMPONENTS CXX)
  magfsi_package("Eigen 3.4, for matrices" libeigen3-dev Eigen3 3.4 NO_MODULE)
  magfsi_package("fmt, for texts" libfmt-dev fmt)
endmacro()
