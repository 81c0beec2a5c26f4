// SPDX-License-Identifier: GPL-2.0-or-later
// Fast kernels: forces, energy and damping of many elements of one lattice, in the
// instruction set of the machine.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/isa/instruction_set.h"
#include "structure/lattice/kernel_data.h"
#include "structure/lattice/lattice.h"

namespace magfsi::structure {

// Storage of batches: one value for each of eight elements, aligned to 64 bytes.
struct alignas(64) Lanes {
    double lane[batch_lanes];
};
// Indices of two nodes for each of eight elements.
struct alignas(64) NodeLanes {
    int lane[2 * batch_lanes];  // two nodes
};

// Elastic forces of a set of elements, packed by material in batches of eight.
class ElementKernel {
  public:
    // set: instruction set of the kernel; the machine must have it.
    explicit ElementKernel(InstructionSet set = choose_instruction_set());

    // Packs these elements of the lattice, which may be freed afterwards. nodes: for each
    // of them the eight indices of its nodes in x and f.
    void assign(const Lattice& lattice, std::span<const int> elements,
                std::span<const std::array<int, 8>> nodes);
    // Packs all elements that are not rigid, with nodes numbered as in the mesh.
    void assign(const Lattice& lattice);

    // Adds the elastic forces [N] at the positions x [m], three values per node. In the
    // result, `element` is the lattice's number of the element of smallest J, -1 without
    // elements.
    KernelResult add_forces(const double* x, double* f) const { return run(x, f, false); }
    // The same; the result also has the energy.
    KernelResult add_forces_and_energy(const double* x, double* f) const {
        return run(x, f, true);
    }

    // Number of elements.
    std::size_t size() const { return size_; }

  private:
    // Packed elements of one material.
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

// Kelvin-Voigt damping: viscous_element for many elements of any variant.
class ViscousKernel {
  public:
    explicit ViscousKernel(InstructionSet set = choose_instruction_set());

    // Packs as ElementKernel::assign does, but only elements of viscous materials. Throws
    // std::invalid_argument on a viscosity that is negative or not finite.
    void assign(const Lattice& lattice, std::span<const int> elements,
                std::span<const std::array<int, 8>> nodes);
    void assign(const Lattice& lattice);

    // Adds the viscous forces [N] at the positions x [m] and velocities v [m/s], three
    // values per node. Returns the dissipation [W], which is minus the power of the
    // forces and never negative. The time step must respect stable_step_s(body), since
    // explicit damping shortens it.
    double add_forces(const double* x, const double* v, double* f) const;

    // True if no element is viscous.
    bool empty() const { return parts_.empty(); }

  private:
    // Packed elements of one material.
    struct Part {
        double viscosity_pa_s = 0, plate_lambda_pa_s = 0;
        int element_count = 0;
        std::vector<NodeLanes> nodes;
        std::vector<Lanes> data;
    };
    ViscousKernelFunction function_ = nullptr;
    bool bricks_ = true;
    std::vector<Part> parts_;
};

}  // namespace magfsi::structure
