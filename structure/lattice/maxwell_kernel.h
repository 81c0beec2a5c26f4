// SPDX-License-Identifier: GPL-2.0-or-later
// Maxwell branches (maxwell.h) of many elements of one lattice, with their states.
#pragma once

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/isa/instruction_set.h"
#include "structure/lattice/element_kernel.h"

namespace magfsi::structure {

class MaxwellKernel {
  public:
    explicit MaxwellKernel(InstructionSet set = choose_instruction_set());

    // Packs as ElementKernel::assign does, but only elements of materials with branches,
    // all of them relaxed. Throws std::invalid_argument on a modulus or a time that is
    // not positive.
    void assign(const Lattice& lattice, std::span<const int> elements,
                std::span<const std::array<int, 8>> nodes);
    void assign(const Lattice& lattice);

    // Adds the forces [N] at the positions x [m], three values per node, after a step of
    // dt_s from the last positions. dt_s = 0: x are the first positions, and states stay.
    MaxwellResult add_forces(const double* x, double dt_s, double* f, bool energy);

    // Values of an element's state: 0 for an element without branches. They are the same
    // on any machine.
    std::size_t values(int element) const;
    // Writes them, or takes them; the kernel must have the element.
    bool has(int element) const { return place_.contains(element); }
    void get(int element, std::span<double> out) const;
    void set(int element, std::span<const double> in);

    bool empty() const { return parts_.empty(); }

  private:
    // Packed elements of one material.
    struct Part {
        Material material;
        std::vector<MaxwellFactors> factors;
        double dt_s = 0;
        double plate_lambda = 0;
        int element_count = 0;
        std::vector<NodeLanes> nodes;
        std::vector<Lanes> data, state;
        std::size_t entries() const {
            return maxwell_numbers * (1 + material.branches.size());
        }
    };
    // Part and position in it of each element.
    struct Place {
        std::size_t part = 0, position = 0;
    };

    MaxwellKernelFunction function_ = nullptr;
    bool bricks_ = true;
    std::vector<Part> parts_;
    std::unordered_map<int, Place> place_;
};

}  // namespace magfsi::structure
