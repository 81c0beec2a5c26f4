# Each of these is one line of packages.txt; docs say why each was chosen.
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)

if(NOT TARGET yaml-cpp::yaml-cpp)  # yaml-cpp before 0.8 exports the bare name
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()

# Reads meshes; Debian ships no CMake package of it.
find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)
add_library(gmsh::gmsh UNKNOWN IMPORTED)
set_target_properties(gmsh::gmsh PROPERTIES
  IMPORTED_LOCATION ${GMSH_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${GMSH_INCLUDE_DIR})

# Checkpoints. The serial library: one rank of a participant writes, so that the file does
# not depend on how many there are.
find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5 REQUIRED)
add_library(hdf5::hdf5 UNKNOWN IMPORTED)
set_target_properties(hdf5::hdf5 PROPERTIES
  IMPORTED_LOCATION ${HDF5_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${HDF5_INCLUDE_DIR})

# Sparse Cholesky factorisation, with OpenMP inside. Its time is spent in BLAS: packages.txt
# names OpenBLAS, several times as fast as the reference library, in its serial variant,
# which starts no threads of its own.
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(cholmod::cholmod UNKNOWN IMPORTED)
set_target_properties(cholmod::cholmod PROPERTIES
  IMPORTED_LOCATION ${CHOLMOD_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CHOLMOD_INCLUDE_DIR}
  INTERFACE_LINK_LIBRARIES gomp)

# The unmodified LAMMPS library. Its headers include a fmt header that Debian does not
# ship; structure/lammps/fmt_shim declares the four names they need, and must come first.
find_path(LAMMPS_INCLUDE_DIR lammps/lammps.h REQUIRED)
find_library(LAMMPS_LIBRARY lammps REQUIRED)
add_library(magfsi_lammps_headers INTERFACE)
target_include_directories(magfsi_lammps_headers SYSTEM BEFORE INTERFACE
  ${PROJECT_SOURCE_DIR}/structure/lammps/fmt_shim ${LAMMPS_INCLUDE_DIR}/lammps)
target_compile_definitions(magfsi_lammps_headers INTERFACE LAMMPS_SMALLBIG)
target_link_libraries(magfsi_lammps_headers INTERFACE ${LAMMPS_LIBRARY} MPI::MPI_CXX)
