#include "structure/lattice/element_kernel.h"

#include <numeric>

#include "structure/lattice/instruction_set.h"

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

ElementKernel::ElementKernel() {
    const InstructionSet set = choose_instruction_set();
    isa_ = name(set);
    function_ = functions[static_cast<std::size_t>(set)];
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
    nodes_ = pack_nodes(nodes);
    const auto pack = [&](int entries, const auto& value) {
        return pack_lanes(elements, static_cast<std::size_t>(entries),
                          [&](int element, std::size_t k) {
                              const auto e = static_cast<std::size_t>(element);
                              return value(lattice.modes[e], k);
                          });
    };
    const bool brick = is_brick(kind_);
    spring_ = pack(brick ? 7 : 28, [=](const ElementModes& modes, std::size_t k) {
        return modes.spring[brick ? static_cast<std::size_t>(diagonal_entries[k]) : k];
    });
    gradient_ =
        pack(gradient_entries(kind_),
             [](const ElementModes& modes, std::size_t k) { return modes.gradient[k]; });
    hourglass_ =
        pack(hourglass_entries(kind_), [=](const ElementModes& modes, std::size_t k) {
            if (brick) {
                return modes.metric[static_cast<std::size_t>(brick_metric_entries[k])];
            }
            return k < 9 ? modes.metric[k] : modes.offset[k - 9];
        });
    volume_ =
        pack(1, [](const ElementModes& modes, std::size_t) { return modes.volume; });
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
