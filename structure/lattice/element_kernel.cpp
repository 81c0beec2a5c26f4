// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/element_kernel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

constexpr std::array<ElementKernelFunction, 3> element_functions{
    &sse2::run_elements, &avx2::run_elements, &avx512::run_elements};

KernelKind kind_of(const Lattice& lattice) {
    if (lattice.variant == ElementVariant::full)
        return lattice.bricks ? KernelKind::brick_full : KernelKind::general_full;
    return lattice.bricks ? KernelKind::brick_assumed_strain
                          : KernelKind::general_assumed_strain;
}

// The soft elements, all in a body without rigid parts, and their nodes.
struct SoftElements {
    std::vector<int> number;
    std::vector<std::array<int, 8>> nodes;
};
SoftElements soft_elements(const Lattice& lattice) {
    SoftElements soft;
    for (std::size_t e = 0; e < lattice.elements.size(); ++e) {
        if (!lattice.element_rigid.empty() && lattice.element_rigid[e] >= 0) continue;
        soft.number.push_back(static_cast<int>(e));
        soft.nodes.push_back(lattice.elements[e]);
    }
    return soft;
}

std::size_t batch_count(std::size_t elements) {
    return (elements + batch_lanes - 1) / batch_lanes;
}

// Node indices in the order [batch][node][lane]. Lanes past the last element repeat it.
std::vector<NodeLanes> pack_nodes(std::span<const std::array<int, 8>> nodes) {
    std::vector<NodeLanes> out(batch_count(nodes.size()) * 4);
    for (std::size_t position = 0; position < out.size() * 2; ++position) {
        const auto& element = nodes[std::min(position, nodes.size() - 1)];
        const std::size_t batch = position / batch_lanes;
        for (std::size_t a = 0; a < 8; ++a) {
            out[batch * 4 + a / 2].lane[(a % 2) * batch_lanes + position % batch_lanes] =
                element[a];
        }
    }
    return out;
}

// Values of value(element, entry) in the order [batch][entry][lane]. Lanes past the last
// element repeat it.
template <class Value>
std::vector<Lanes> pack_lanes(std::span<const int> elements, std::size_t entries,
                              const Value& value) {
    std::vector<Lanes> out(batch_count(elements.size()) * entries);
    if (entries == 0) return out;
    for (std::size_t row = 0; row < out.size(); ++row) {
        for (std::size_t lane = 0; lane < batch_lanes; ++lane) {
            const std::size_t position = row / entries * batch_lanes + lane;
            const int element = elements[std::min(position, elements.size() - 1)];
            out[row].lane[lane] = value(element, row % entries);
        }
    }
    return out;
}

constexpr std::array<ViscousKernelFunction, 3> viscous_functions{
    &sse2::run_viscous, &avx2::run_viscous, &avx512::run_viscous};

// Entry k of the data that the viscous kernel reads for a brick: volume, gradient,
// metric.
double brick_entry(const ElementModes& modes, std::size_t k) {
    // The non-zero entries: B_x of the mode x, B_y of y, B_z of z, in rows 0, 1 and 3 of
    // the gradient.
    constexpr std::array<std::size_t, 3> diagonal{0, 4, 11};
    if (k == 0) return modes.volume;
    if (k < 4) return modes.gradient[diagonal[k - 1]];
    return modes.metric[brick_metric_entries[k - 4]];
}

// Entry k for a general element: volume, gradient, metric, offsets.
double general_entry(const ElementModes& modes, std::size_t k) {
    if (k == 0) return modes.volume;
    if (k < 22) return modes.gradient[k - 1];
    if (k < 31) return modes.metric[k - 22];
    return modes.offset[k - 31];
}

// NaN is refused as well: no comparison with it is true.
void check_viscosity(const Material& material) {
    const double viscosity = material.viscosity_pa_s;
    if (viscosity >= 0 && !std::isinf(viscosity)) return;
    refuse("a solid viscosity of {:g} Pa s found, it must be zero or positive",
           viscosity);
}

}  // namespace

ElementKernel::ElementKernel(InstructionSet set)
    : function_(element_functions[static_cast<int>(set)]) {}

void ElementKernel::assign(const Lattice& lattice) {
    const SoftElements soft = soft_elements(lattice);
    assign(lattice, soft.number, soft.nodes);
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
                              const std::size_t e = element;
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
                return modes.metric[brick_metric_entries[k]];
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

// The kernel numbers elements within its batches; the result has the lattice's number.
KernelResult ElementKernel::run(const Part& part, const double* x, double* f,
                                bool energy) const {
    ElementBatches batches;
    batches.kind = kind_;
    batches.element_count = part.elements.size();
    batches.node = part.nodes.front().lane;
    batches.spring = part.spring.front().lane;
    batches.gradient = part.gradient.empty() ? nullptr : part.gradient.front().lane;
    batches.hourglass = part.hourglass.empty() ? nullptr : part.hourglass.front().lane;
    batches.volume = part.volume.front().lane;
    batches.shear_modulus_pa = part.material.shear_modulus_pa;
    batches.lame_lambda_pa = part.material.lame_lambda_pa;
    KernelResult result = function_(batches, x, f, energy);
    if (result.element >= 0) {
        result.element = part.elements[result.element];
    }
    return result;
}

ViscousKernel::ViscousKernel(InstructionSet set)
    : function_(viscous_functions[static_cast<int>(set)]) {}

void ViscousKernel::assign(const Lattice& lattice) {
    const SoftElements soft = soft_elements(lattice);
    assign(lattice, soft.number, soft.nodes);
}

void ViscousKernel::assign(const Lattice& lattice, std::span<const int> elements,
                           std::span<const std::array<int, 8>> nodes) {
    for (const Material& material : lattice.materials) check_viscosity(material);
    bricks_ = lattice.bricks;
    parts_.clear();
    for (const MaterialPart& wanted : material_parts(lattice, elements, nodes)) {
        if (wanted.material.viscosity_pa_s == 0) continue;
        Part& part = parts_.emplace_back();
        part.viscosity_pa_s = wanted.material.viscosity_pa_s;
        part.plate_lambda_pa_s = viscous_plate_lambda_pa_s(wanted.material);
        part.element_count = wanted.elements.size();
        part.nodes = pack_nodes(wanted.nodes);
        part.data = pack_lanes(
            wanted.elements, static_cast<std::size_t>(viscous_entries(bricks_)),
            [&](int element, std::size_t k) {
                const ElementModes& modes = lattice.modes[element];
                return bricks_ ? brick_entry(modes, k) : general_entry(modes, k);
            });
    }
}

double ViscousKernel::add_forces(const double* x, const double* v, double* f) const {
    double dissipation_w = 0;
    for (const Part& part : parts_) {
        ViscousBatches batches;
        batches.bricks = bricks_;
        batches.element_count = part.element_count;
        batches.node = part.nodes.front().lane;
        batches.data = part.data.front().lane;
        batches.viscosity_pa_s = part.viscosity_pa_s;
        batches.plate_lambda_pa_s = part.plate_lambda_pa_s;
        dissipation_w += function_(batches, x, v, f);
    }
    return dissipation_w;
}

}  // namespace magfsi::structure
