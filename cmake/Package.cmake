# SPDX-License-Identifier: GPL-2.0-or-later
# cpack: Debian packages of the three components of Install.cmake.
#   cd build/release && cpack           magfsi_*.deb, magfsi-openfoam_*.deb, magfsi-dev_*.deb
# Names are not libraries' only: what the launcher starts and what the Python package imports is
# added by hand; the libraries are found by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME magfsi)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The magfsi developers <magfsi@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev)
if(TARGET magfsi_openfoam_engine)
  list(APPEND CPACK_COMPONENTS_ALL openfoam)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME magfsi)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
  "${PROJECT_DESCRIPTION}\nSoft magnetic bodies in the unmodified LAMMPS library, a lattice-Boltzmann fluid, and\nthe coupling of both; scenes, studies, searches and figures.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
  "openmpi-bin, libopenblas0-serial, python3 (>= 3.11), python3-numpy, python3-matplotlib, python3-yaml, python3-vtk9, libjs-chart.js")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS
  "python3-scipy, xvfb, python3-optuna, python3-cmaes")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "magfsi-openfoam, python3-pandas, ffmpeg")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/install/prerm)

# Its libraries have no SONAMEs by which dpkg-shlibdeps could find them.
set(CPACK_DEBIAN_OPENFOAM_PACKAGE_NAME magfsi-openfoam)
set(CPACK_COMPONENT_OPENFOAM_DESCRIPTION "magfsi's second fluid: OpenFOAM's pimpleFoam")
set(CPACK_DEBIAN_OPENFOAM_PACKAGE_DEPENDS "magfsi (= ${PROJECT_VERSION}), openfoam")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME magfsi-dev)
set(CPACK_COMPONENT_DEV_DESCRIPTION "magfsi's libraries and headers for programs in C++")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "magfsi (= ${PROJECT_VERSION}), cmake, g++, libopenmpi-dev, liblammps-dev, libeigen3-dev, libsuitesparse-dev, libyaml-cpp-dev, libmuparser-dev, libcli11-dev, libfmt-dev, libspdlog-dev, nlohmann-json3-dev, libhdf5-dev")
include(CPack)
