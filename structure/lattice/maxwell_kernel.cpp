// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/maxwell_kernel.h"

#include <stdexcept>
#include <utility>

#include "structure/lattice/maxwell.h"
#include "structure/lattice/packing.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

constexpr std::array<MaxwellKernelFunction, 3> maxwell_functions{
    &sse2::run_maxwell, &avx2::run_maxwell, &avx512::run_maxwell};

// NaN is refused as well: no comparison with it is true.
void check_branches(const Material& material) {
    for (const MaxwellBranch& branch : material.branches) {
        if (branch.modulus_pa > 0 && branch.time_s > 0) continue;
        refuse(
            "a Maxwell branch of {:g} Pa and {:g} s found, modulus and time must be "
            "positive",
            branch.modulus_pa, branch.time_s);
    }
}

}  // namespace

MaxwellKernel::MaxwellKernel(InstructionSet set)
    : function_(maxwell_functions[static_cast<int>(set)]) {}

void MaxwellKernel::assign(const Lattice& lattice) {
    const SoftElements soft = soft_elements(lattice);
    assign(lattice, soft.number, soft.nodes);
}

void MaxwellKernel::assign(const Lattice& lattice, std::span<const int> elements,
                           std::span<const std::array<int, 8>> nodes) {
    for (const Material& material : lattice.materials) check_branches(material);
    bricks_ = lattice.bricks;
    parts_.clear();
    place_.clear();
    for (MaterialPart& wanted : material_parts(lattice, elements, nodes)) {
        if (wanted.material.branches.empty()) continue;
        Part& part = parts_.emplace_back();
        part.material = wanted.material;
        part.plate_lambda = maxwell_plate_lambda(wanted.material);
        part.factors = maxwell_factors(part.material, 0);
        part.element_count = wanted.elements.size();
        part.nodes = pack_nodes(wanted.nodes);
        part.data = pack_lanes(
            wanted.elements, static_cast<std::size_t>(viscous_entries(bricks_)),
            [&](int element, std::size_t k) {
                return viscous_entry(lattice.modes[element], bricks_, k);
            });
        part.state.assign(batch_count(wanted.elements.size()) * part.entries(), Lanes{});
        for (std::size_t i = 0; i < wanted.elements.size(); ++i)
            place_[wanted.elements[i]] = {parts_.size() - 1, i};
    }
}

MaxwellResult MaxwellKernel::add_forces(const double* x, double dt_s, double* f,
                                        bool energy) {
    MaxwellResult sum;
    for (Part& part : parts_) {
        if (part.dt_s != dt_s) {
            part.factors = maxwell_factors(part.material, dt_s);
            part.dt_s = dt_s;
        }
        MaxwellBatches batches;
        batches.bricks = bricks_;
        batches.element_count = part.element_count;
        batches.node = part.nodes.front().lane;
        batches.data = part.data.front().lane;
        batches.state = part.state.front().lane;
        batches.branch_count = static_cast<int>(part.factors.size());
        batches.branches = part.factors.data();
        batches.plate_lambda = part.plate_lambda;
        const MaxwellResult result = function_(batches, x, f, energy);
        sum.dissipation_w += result.dissipation_w;
        sum.energy_j += result.energy_j;
    }
    return sum;
}

std::size_t MaxwellKernel::values(int element) const {
    const auto found = place_.find(element);
    return found == place_.end() ? 0 : parts_[found->second.part].entries();
}

void MaxwellKernel::get(int element, std::span<double> out) const {
    const auto [number, position] = place_.at(element);
    const Part& part = parts_[number];
    const Lanes* first = &part.state[position / batch_lanes * part.entries()];
    for (std::size_t k = 0; k < part.entries(); ++k)
        out[k] = first[k].lane[position % batch_lanes];
}

void MaxwellKernel::set(int element, std::span<const double> in) {
    const auto [number, position] = place_.at(element);
    Part& part = parts_[number];
    Lanes* first = &part.state[position / batch_lanes * part.entries()];
    for (std::size_t k = 0; k < part.entries(); ++k)
        first[k].lane[position % batch_lanes] = in[k];
}

}  // namespace magfsi::structure
