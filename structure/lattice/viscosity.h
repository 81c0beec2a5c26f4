// Kelvin-Voigt damping of many elements of one lattice, in the instruction set of the
// machine. See viscous_element.h for the model.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "isa/instruction_set.h"
#include "structure/lattice/lane_packing.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/viscous_batches.h"

namespace magfsi::structure {

class ViscousKernel {
  public:
    explicit ViscousKernel(InstructionSet set = choose_instruction_set());

    // Packs those of these elements (any variant) whose material is viscous; nodes: for
    // each of them the eight indices of its nodes in x, v and f. Throws
    // std::invalid_argument on a viscosity that is negative or not finite.
    void assign(const Lattice& lattice, std::span<const int> elements,
                std::span<const std::array<int, 8>> nodes);
    // All elements, nodes numbered as in the mesh.
    void assign(const Lattice& lattice);

    // Adds the forces [N] at positions x [m] and velocities v [m/s], three values a node;
    // returns the dissipation [W], minus the power of the forces, never negative. The
    // step must respect stable_step_s(body): explicit damping shortens it.
    double add_forces(const double* x, const double* v, double* f) const;

    bool empty() const { return parts_.empty(); }

  private:
    // The elements of one material.
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
