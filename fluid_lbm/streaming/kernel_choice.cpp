#include "fluid_lbm/streaming/kernel_choice.h"

#include <cstdlib>
#include <stdexcept>

namespace magfsi::fluid {

namespace sse2 {
extern const KernelSet kernels;
}
namespace avx2 {
extern const KernelSet kernels;
}
namespace avx512 {
extern const KernelSet kernels;
}

std::vector<NamedKernels> available_kernels() {
    std::vector<NamedKernels> available{{"sse2", sse2::kernels}};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        available.push_back({"avx2", avx2::kernels});
    }
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
        available.push_back({"avx512", avx512::kernels});
    }
    return available;
}

NamedKernels choose_kernels() {
    const std::vector<NamedKernels> available = available_kernels();
    const char* wanted = std::getenv("MAGFSI_ISA");
    if (wanted == nullptr || *wanted == '\0') return available.back();
    std::string names;
    for (const NamedKernels& set : available) {
        if (set.name == wanted) return set;
        names += (names.empty() ? "" : ", ") + set.name;
    }
    throw std::invalid_argument("MAGFSI_ISA is \"" + std::string(wanted) +
                                "\"; this machine can run: " + names);
}

Collision choose_collision(Collision wanted) {
    return wanted == Collision::automatic ? Collision::recursive_regularized : wanted;
}

RowKernels row_kernels(const KernelSet& kernels, Collision collision) {
    return choose_collision(collision) == Collision::bgk ? kernels.bgk
                                                         : kernels.recursive_regularized;
}

}  // namespace magfsi::fluid
