# SPDX-License-Identifier: GPL-2.0-or-later
option(MAGFSI_TESTS "Build the tests" ON)
option(MAGFSI_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
option(MAGFSI_TRAPS "End a participant at an invalid operation, a division by 0, an overflow" OFF)
option(MAGFSI_FUZZ "Build the fuzzer of the scene reader; needs clang" OFF)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# Every target of ours links this: warnings are errors, headers are found from the top
# ("structure/mesh/mesh.h"), and never -ffast-math, which would defeat the NaN checks.
add_library(magfsi_options INTERFACE)
target_include_directories(magfsi_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/magfsi>)
target_compile_features(magfsi_options INTERFACE $<INSTALL_INTERFACE:cxx_std_20>)
target_compile_options(magfsi_options INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wnon-virtual-dtor;-Woverloaded-virtual;-Werror>)
# GCC collects its garbage from 600 MB on, not from 128 MB: a large file took 23 s in place of 27.
target_compile_options(magfsi_options INTERFACE
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=600000>>)

# magfsi_cold(TARGET ...): -O1 in place of -O3 for code that runs at start-up or writes text; it
# compiles in two thirds of the time. Floating-point results do not depend on it.
function(magfsi_cold)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

if(MAGFSI_FUZZ)
  target_compile_options(magfsi_options INTERFACE
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined)
  target_link_options(magfsi_options INTERFACE -fsanitize=address,undefined)
endif()
if(MAGFSI_SANITIZE)
  target_compile_options(magfsi_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(magfsi_options INTERFACE -fsanitize=address,undefined)
endif()
