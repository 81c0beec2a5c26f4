#include "structure/lattice/instruction_set.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace magfsi::structure {
namespace {

constexpr std::array sets{InstructionSet::sse2, InstructionSet::avx2,
                          InstructionSet::avx512};

bool available(InstructionSet set) {
    if (set == InstructionSet::sse2) return true;
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (set == InstructionSet::avx2) return avx2;
    return avx2 && __builtin_cpu_supports("avx512f") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw");
}

}  // namespace

const char* name(InstructionSet set) {
    constexpr std::array names{"sse2", "avx2", "avx512"};
    return names[static_cast<std::size_t>(set)];
}

InstructionSet choose_instruction_set() {
    const char* wish = std::getenv("MAGFSI_ISA");
    InstructionSet chosen = InstructionSet::sse2;
    for (InstructionSet set : sets) {
        if (available(set)) chosen = set;
        if (wish != nullptr && std::string_view(wish) == name(set)) return chosen;
    }
    if (wish != nullptr) {
        throw std::invalid_argument(fmt::format(
            "MAGFSI_ISA is \"{}\", but only sse2, avx2 and avx512 are known", wish));
    }
    return chosen;
}

}  // namespace magfsi::structure
