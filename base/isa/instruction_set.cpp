// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/isa/instruction_set.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace magfsi {

const char* name(InstructionSet set) {
    switch (set) {
        case InstructionSet::sse2:
            return "sse2";
        case InstructionSet::avx2:
            return "avx2";
        case InstructionSet::avx512:
            break;
    }
    return "avx512";
}

std::vector<InstructionSet> available_instruction_sets() {
    std::vector<InstructionSet> available{InstructionSet::sse2};
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
        return available;
    }
    available.push_back(InstructionSet::avx2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
        available.push_back(InstructionSet::avx512);
    }
    return available;
}

InstructionSet choose_instruction_set() {
    const std::vector<InstructionSet> available = available_instruction_sets();
    const char* wanted = std::getenv("MAGFSI_ISA");
    if (wanted == nullptr || *wanted == '\0') return available.back();
    std::string names;
    for (InstructionSet set : available) {
        if (std::string(wanted) == name(set)) return set;
        names += (names.empty() ? "" : ", ") + std::string(name(set));
    }
    throw std::invalid_argument("MAGFSI_ISA is \"" + std::string(wanted) +
                                "\"; this machine can run: " + names);
}

}  // namespace magfsi
