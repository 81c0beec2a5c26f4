# SPDX-License-Identifier: GPL-2.0-or-later
# magfsi_precompiled(TARGET ...): the headers that most sources include are compiled once. No
# source may rely on it: the presets debug, asan and fuzz build without. It does not pay for files
# that include JSON. GCC 12 forgets that the standard library's headers are the system's, of which
# it shows no warnings: where it warns falsely, a file or target goes without.
add_library(magfsi_precompiled OBJECT ${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp)
target_link_libraries(magfsi_precompiled PRIVATE magfsi_options Eigen3::Eigen fmt::fmt)
set(MAGFSI_COMMON_HEADERS
  <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
  <memory> <numbers> <numeric> <optional> <set> <span> <sstream> <stdexcept> <string>
  <string_view> <tuple> <utility> <variant> <vector>
  <fmt/format.h> <fmt/ranges.h> <Eigen/Dense>)
target_precompile_headers(magfsi_precompiled PRIVATE ${MAGFSI_COMMON_HEADERS})

function(magfsi_precompiled)
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM magfsi_precompiled)
    target_link_libraries(${target} PRIVATE fmt::fmt)  # the same macros
  endforeach()
endfunction()
