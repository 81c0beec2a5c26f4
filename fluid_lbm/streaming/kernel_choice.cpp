#include "fluid_lbm/streaming/kernel_choice.h"

#include <cstdlib>
#include <stdexcept>

namespace magfsi::fluid {

#define MAGFSI_KERNELS_OF(isa)                                              \
    namespace isa {                                                         \
    extern const KernelTable<double> on_double;                             \
    extern const KernelTable<float> on_float;                               \
    extern const KernelTable<float> on_float_in_double;                     \
    const KernelSet kernels = {&on_double, &on_float, &on_float_in_double}; \
    }
MAGFSI_KERNELS_OF(sse2)
MAGFSI_KERNELS_OF(avx2)
MAGFSI_KERNELS_OF(avx512)
#undef MAGFSI_KERNELS_OF

namespace {

template <class Real>
ChosenKernels<Real> choose(const KernelTable<Real>& table, Collision collision,
                           bool eddy_viscosity) {
    for (const CollisionKernels<Real>& kernels : table.collisions) {
        if (kernels.kind != collision) continue;
        return {eddy_viscosity ? kernels.with_eddy_viscosity : kernels.laminar,
                table.moments};
    }
    throw std::invalid_argument("no kernel is registered for collision " +
                                std::string(name_of(collision)));
}

}  // namespace

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

AnyKernels run_kernels(const KernelSet& kernels, Precision precision, Collision collision,
                       bool eddy_viscosity) {
    switch (precision) {
        case Precision::float_:
            return choose(*kernels.on_float, collision, eddy_viscosity);
        case Precision::float_double:
            return choose(*kernels.on_float_in_double, collision, eddy_viscosity);
        case Precision::double_:
            break;
    }
    return choose(*kernels.on_double, collision, eddy_viscosity);
}

}  // namespace magfsi::fluid
