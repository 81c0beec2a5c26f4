# SPDX-License-Identifier: GPL-2.0-or-later
# magfsi_isa_variants(TARGET FILE [OPTION ...]): compiles FILE three times, for SSE2, AVX2 and
# AVX-512, with the compiler's OPTIONs, and adds the objects to TARGET. Inside FILE the macro
# MAGFSI_ISA names the variant (sse2, avx2, avx512): put everything into `namespace MAGFSI_ISA` so
# that no symbol is shared.
# FILE must not instantiate templates of the standard library: the linker could keep the
# AVX-512 copy of one and run it on a machine without AVX-512.
# The default build thus runs on any x86-64 and picks its kernels at start-up:
# base/isa/instruction_set.h. What kernels are written in: base/isa/simd.h.
add_library(magfsi_isa STATIC ${CMAKE_CURRENT_LIST_DIR}/../base/isa/instruction_set.cpp)
target_link_libraries(magfsi_isa PUBLIC magfsi_options)

function(magfsi_isa_variants target file)
  set(flags_sse2 -msse2)
  set(flags_avx2 -mavx2 -mfma)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma -mprefer-vector-width=512)
  get_filename_component(stem ${file} NAME_WE)
  foreach(isa sse2 avx2 avx512)
    set(object ${target}_${stem}_${isa})
    add_library(${object} OBJECT ${file})
    target_link_libraries(${object} PRIVATE magfsi_isa)
    target_compile_definitions(${object} PRIVATE MAGFSI_ISA=${isa} MAGFSI_ISA_${isa})
    target_compile_options(${object} PRIVATE ${flags_${isa}} -O3 -Wno-psabi ${ARGN})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
  endforeach()
  target_link_libraries(${target} PUBLIC magfsi_isa)
endfunction()
