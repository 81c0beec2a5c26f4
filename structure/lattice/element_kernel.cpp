#include "structure/lattice/element_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

namespace magfsi::structure {
namespace {

struct Isa {
    const char* name;
    ElementKernelFunction function;
    bool available;
};

std::array<Isa, 3> instruction_sets() {
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool avx512 =
        avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    return {{{"sse2", &sse2::run_elements, true},
             {"avx2", &avx2::run_elements, avx2},
             {"avx512", &avx512::run_elements, avx512}}};
}

Isa choose_isa() {
    const auto sets = instruction_sets();
    const char* wish = std::getenv("MAGFSI_ISA");
    Isa chosen = sets[0];
    bool known = wish == nullptr;
    for (const Isa& set : sets) {
        if (set.available) chosen = set;
        if (wish != nullptr && std::string(wish) == set.name) {
            known = true;
            break;
        }
    }
    if (!known) {
        throw std::invalid_argument(fmt::format(
            "MAGFSI_ISA is \"{}\", but only sse2, avx2 and avx512 are known", wish));
    }
    return chosen;
}

KernelKind kind_of(const Lattice& lattice) {
    switch (lattice.variant) {
        case ElementVariant::full:
            return lattice.bricks ? KernelKind::brick_full : KernelKind::general_full;
        case ElementVariant::mean_f:
            return lattice.bricks ? KernelKind::brick_mean_f : KernelKind::general_mean_f;
        case ElementVariant::assumed_strain:
            break;
    }
    return lattice.bricks ? KernelKind::brick_assumed_strain
                          : KernelKind::general_assumed_strain;
}

}  // namespace

ElementKernel::ElementKernel() {
    const Isa isa = choose_isa();
    isa_ = isa.name;
    function_ = isa.function;
}

void ElementKernel::assign(const Lattice& lattice) {
    std::vector<int> all(lattice.elements.size());
    std::iota(all.begin(), all.end(), 0);
    assign(lattice, all, lattice.elements);
}

void ElementKernel::assign(const Lattice& lattice, std::span<const int> elements,
                           std::span<const std::array<int, 8>> nodes) {
    kind_ = kind_of(lattice);
    material_ = lattice.material;
    elements_.assign(elements.begin(), elements.end());
    const std::size_t batches = (elements.size() + batch_lanes - 1) / batch_lanes;
    nodes_.assign(batches * 4, {});
    spring_.assign(batches * (is_brick(kind_) ? 7 : 28), {});
    gradient_.assign(batches * static_cast<std::size_t>(gradient_entries(kind_)), {});
    hourglass_.assign(batches * static_cast<std::size_t>(hourglass_entries(kind_)), {});
    volume_.assign(batches, {});
    for (std::size_t position = 0; position < batches * batch_lanes; ++position) {
        const std::size_t source = std::min(position, elements.size() - 1);
        pack(lattice.modes[elements[source]], position);
        const std::size_t batch = position / batch_lanes;
        const std::size_t lane = position % batch_lanes;
        for (std::size_t a = 0; a < 8; ++a) {
            nodes_[batch * 4 + a / 2].lane[(a % 2) * batch_lanes + lane] =
                nodes[source][a];
        }
    }
}

void ElementKernel::pack(const ElementModes& modes, std::size_t position) {
    const std::size_t batch = position / batch_lanes;
    const std::size_t lane = position % batch_lanes;
    const auto put = [batch, lane](std::vector<Lanes>& lanes, std::size_t entries,
                                   const auto& value) {
        for (std::size_t k = 0; k < entries; ++k) {
            lanes[batch * entries + k].lane[lane] = value(k);
        }
    };
    volume_[batch].lane[lane] = modes.volume;
    if (is_brick(kind_)) {
        put(spring_, 7, [&](std::size_t k) { return modes.spring[diagonal_entries[k]]; });
        if (hourglass_.empty()) return;
        put(hourglass_, 3,
            [&](std::size_t k) { return modes.metric[brick_metric_entries[k]]; });
        return;
    }
    put(spring_, 28, [&](std::size_t k) { return modes.spring[k]; });
    if (gradient_.empty()) return;
    put(gradient_, 21, [&](std::size_t k) { return modes.gradient[k]; });
    if (hourglass_.empty()) return;
    put(hourglass_, 18,
        [&](std::size_t k) { return k < 9 ? modes.metric[k] : modes.offset[k - 9]; });
}

KernelResult ElementKernel::run(const double* x, double* f, bool energy) const {
    if (elements_.empty()) return {};
    ElementBatches batches;
    batches.kind = kind_;
    batches.element_count = static_cast<int>(elements_.size());
    batches.node = nodes_.front().lane;
    batches.spring = spring_.front().lane;
    batches.gradient = gradient_.empty() ? nullptr : gradient_.front().lane;
    batches.hourglass = hourglass_.empty() ? nullptr : hourglass_.front().lane;
    batches.volume = volume_.front().lane;
    batches.shear_modulus_pa = material_.shear_modulus_pa;
    batches.lame_lambda_pa = material_.lame_lambda_pa;
    KernelResult result = function_(batches, x, f, energy);
    if (result.element >= 0) result.element = elements_[result.element];
    return result;
}

}  // namespace magfsi::structure
