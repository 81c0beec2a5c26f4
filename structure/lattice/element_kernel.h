// The fast kernel: forces and energy of many elements of one lattice, in the instruction
// set of the machine.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "isa/instruction_set.h"
#include "structure/lattice/element_batches.h"
#include "structure/lattice/lane_packing.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/material_parts.h"

namespace magfsi::structure {

class ElementKernel {
  public:
    explicit ElementKernel(InstructionSet set = choose_instruction_set());

    // Packs these elements of the lattice; nodes: for each of them the eight indices of
    // its nodes in x and f.
    void assign(const Lattice& lattice, std::span<const int> elements,
                std::span<const std::array<int, 8>> nodes);
    // All elements, nodes numbered as in the mesh.
    void assign(const Lattice& lattice);

    // Adds the forces [N] at positions x [m], three values a node. KernelResult::element
    // is the lattice's number of the element of smallest J (-1 if there are no elements).
    KernelResult add_forces(const double* x, double* f) const { return run(x, f, false); }
    KernelResult add_forces_and_energy(const double* x, double* f) const {
        return run(x, f, true);
    }

    std::size_t size() const { return size_; }

  private:
    // The elements of one material.
    struct Part {
        Material material;
        std::vector<int> elements;
        std::vector<NodeLanes> nodes;
        std::vector<Lanes> spring, gradient, hourglass, volume;
    };
    Part pack(const Lattice& lattice, MaterialPart wanted) const;
    KernelResult run(const double* x, double* f, bool energy) const;
    KernelResult run(const Part& part, const double* x, double* f, bool energy) const;

    ElementKernelFunction function_ = nullptr;
    KernelKind kind_ = KernelKind::brick_full;
    std::size_t size_ = 0;
    std::vector<Part> parts_;
};

}  // namespace magfsi::structure
