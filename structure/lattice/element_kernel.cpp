#include "structure/lattice/element_kernel.h"

#include <numeric>
#include <utility>

namespace magfsi::structure {
namespace {

constexpr std::array<ElementKernelFunction, 3> functions{
    &sse2::run_elements, &avx2::run_elements, &avx512::run_elements};

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

ElementKernel::ElementKernel(InstructionSet set)
    : function_(functions[static_cast<std::size_t>(set)]) {}

void ElementKernel::assign(const Lattice& lattice) {
    std::vector<int> all(lattice.elements.size());
    std::iota(all.begin(), all.end(), 0);
    assign(lattice, all, lattice.elements);
}

void ElementKernel::assign(const Lattice& lattice, std::span<const int> elements,
                           std::span<const std::array<int, 8>> nodes) {
    kind_ = kind_of(lattice);
    size_ = elements.size();
    parts_.clear();
    for (MaterialPart& part : material_parts(lattice, elements, nodes)) {
        parts_.push_back(pack(lattice, std::move(part)));
    }
}

ElementKernel::Part ElementKernel::pack(const Lattice& lattice,
                                        MaterialPart wanted) const {
    Part part;
    part.material = wanted.material;
    part.elements = std::move(wanted.elements);
    part.nodes = pack_nodes(wanted.nodes);
    const auto lanes = [&](int entries, const auto& value) {
        return pack_lanes(part.elements, static_cast<std::size_t>(entries),
                          [&](int element, std::size_t k) {
                              const auto e = static_cast<std::size_t>(element);
                              return value(lattice.modes[e], k);
                          });
    };
    const bool brick = is_brick(kind_);
    part.spring = lanes(brick ? 7 : 28, [=](const ElementModes& modes, std::size_t k) {
        return modes.spring[brick ? static_cast<std::size_t>(diagonal_entries[k]) : k];
    });
    part.gradient =
        lanes(gradient_entries(kind_),
              [](const ElementModes& modes, std::size_t k) { return modes.gradient[k]; });
    part.hourglass =
        lanes(hourglass_entries(kind_), [=](const ElementModes& modes, std::size_t k) {
            if (brick) {
                return modes.metric[static_cast<std::size_t>(brick_metric_entries[k])];
            }
            return k < 9 ? modes.metric[k] : modes.offset[k - 9];
        });
    part.volume =
        lanes(1, [](const ElementModes& modes, std::size_t) { return modes.volume; });
    return part;
}

KernelResult ElementKernel::run(const double* x, double* f, bool energy) const {
    if (parts_.empty()) return {};
    KernelResult all = run(parts_.front(), x, f, energy);
    for (std::size_t p = 1; p < parts_.size(); ++p) {
        const KernelResult next = run(parts_[p], x, f, energy);
        all.energy_j += next.energy_j;
        if (next.smallest_j < all.smallest_j) {
            all.smallest_j = next.smallest_j;
            all.element = next.element;
        }
    }
    return all;
}

KernelResult ElementKernel::run(const Part& part, const double* x, double* f,
                                bool energy) const {
    ElementBatches batches;
    batches.kind = kind_;
    batches.element_count = static_cast<int>(part.elements.size());
    batches.node = part.nodes.front().lane;
    batches.spring = part.spring.front().lane;
    batches.gradient = part.gradient.empty() ? nullptr : part.gradient.front().lane;
    batches.hourglass = part.hourglass.empty() ? nullptr : part.hourglass.front().lane;
    batches.volume = part.volume.front().lane;
    batches.shear_modulus_pa = part.material.shear_modulus_pa;
    batches.lame_lambda_pa = part.material.lame_lambda_pa;
    KernelResult result = function_(batches, x, f, energy);
    if (result.element >= 0) {
        result.element = part.elements[static_cast<std::size_t>(result.element)];
    }
    return result;
}

}  // namespace magfsi::structure
