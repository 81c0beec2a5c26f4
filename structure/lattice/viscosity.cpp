#include "structure/lattice/viscosity.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "structure/lattice/material_parts.h"
#include "structure/lattice/viscous_element.h"

namespace magfsi::structure {
namespace {

constexpr std::array<ViscousKernelFunction, 3> functions{
    &sse2::run_viscous, &avx2::run_viscous, &avx512::run_viscous};

double brick_entry(const ElementModes& modes, std::size_t k) {
    // B_x of the mode x, B_y of y, B_z of z: rows 0, 1 and 3 of the gradient.
    constexpr std::array<std::size_t, 3> diagonal{0, 4, 11};
    if (k == 0) return modes.volume;
    if (k < 4) return modes.gradient[diagonal[k - 1]];
    return modes.metric[static_cast<std::size_t>(brick_metric_entries[k - 4])];
}

double general_entry(const ElementModes& modes, std::size_t k) {
    if (k == 0) return modes.volume;
    if (k < 22) return modes.gradient[k - 1];
    if (k < 31) return modes.metric[k - 22];
    return modes.offset[k - 31];
}

void check_viscosity(const Material& material) {
    const double viscosity = material.viscosity_pa_s;
    if (viscosity >= 0 && !std::isinf(viscosity)) return;
    throw std::invalid_argument(fmt::format(
        "a solid viscosity of {:g} Pa s found, it must be zero or positive", viscosity));
}

}  // namespace

ViscousKernel::ViscousKernel(InstructionSet set)
    : function_(functions[static_cast<std::size_t>(set)]) {}

void ViscousKernel::assign(const Lattice& lattice) {
    std::vector<int> all(lattice.elements.size());
    std::iota(all.begin(), all.end(), 0);
    assign(lattice, all, lattice.elements);
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
        part.element_count = static_cast<int>(wanted.elements.size());
        part.nodes = pack_nodes(wanted.nodes);
        part.data = pack_lanes(
            wanted.elements, static_cast<std::size_t>(viscous_entries(bricks_)),
            [&](int element, std::size_t k) {
                const ElementModes& modes =
                    lattice.modes[static_cast<std::size_t>(element)];
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
