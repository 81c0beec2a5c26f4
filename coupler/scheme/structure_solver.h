// SPDX-License-Identifier: GPL-2.0-or-later
// What a structure offers to the coupling, as GridFluid does for a fluid. It stands alone
// for the sake of solvers whose own headers do not go with those of our libraries.
#pragma once

#include <cstdint>
#include <functional>

namespace magfsi::coupler {

// Nodes have local indices on their rank, ghosts
// of other ranks' nodes too, which stay the same from step to step.
class StructureSolver {
  public:
    virtual ~StructureSolver() = default;

    // Three values per node. The velocities of ghosts are of the last half step until
    // they are renewed, which is collective.
    virtual const double* positions() const = 0;
    virtual const double* velocities() const = 0;
    virtual void renew_ghost_velocities() = 0;

    // Called in every substep with the velocities and the forces, to which it adds.
    using NodalForce =
        std::function<void(const double* velocity, double* force, double substep_s)>;
    virtual void attach_fluid_force(NodalForce force) = 0;

    virtual void advance() = 0;                              // one coupled step
    virtual void check_finite(std::int64_t step) const = 0;  // throws Diverged

    // For schemes that repeat a step: keep() notes the state between two steps, in
    // memory; go_back() returns to it from the step's end, as often as is wanted.
    virtual void keep() = 0;
    virtual void go_back() = 0;  // collective
};

}  // namespace magfsi::coupler
