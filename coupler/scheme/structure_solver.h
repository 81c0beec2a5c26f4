// SPDX-License-Identifier: GPL-2.0-or-later
// The interface of a structure solver to the coupling, as GridFluid is for fluids. It is
// in a header of its own for solvers whose headers do not go with those of other
// libraries.
#pragma once

#include <cstdint>
#include <functional>

namespace magfsi::coupler {

// A structure that the fluid's force acts on. Nodes have local indices on their rank, as
// have the ghosts of other ranks' nodes; indices stay the same from step to step.
class StructureSolver {
  public:
    virtual ~StructureSolver() = default;

    // Positions [m] and velocities [m/s], three values per node. The velocities of ghosts
    // are those of the last half step until they are renewed, which is collective.
    virtual const double* positions() const = 0;
    virtual const double* velocities() const = 0;
    virtual void renew_ghost_velocities() = 0;

    // Called in every substep of substep_s [s] with the velocities [m/s] and the forces
    // [N], to which it adds.
    using NodalForce =
        std::function<void(const double* velocity, double* force, double substep_s)>;
    virtual void attach_fluid_force(NodalForce force) = 0;

    virtual void advance() = 0;                              // one coupled step
    virtual void check_finite(std::int64_t step) const = 0;  // throws Diverged

    // For schemes that repeat a step. keep() stores the state between two steps in
    // memory; go_back() returns to it from the step's end, any number of times.
    virtual void keep() = 0;
    virtual void go_back() = 0;  // collective
};

}  // namespace magfsi::coupler
