// SPDX-License-Identifier: GPL-2.0-or-later
// How many LAMMPS steps make one coupled step, at the start and as bodies deform.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "adapters/bodies/nodal_state.h"
#include "adapters/scene/scene.h"
#include "structure/body.h"
#include "structure/lattice/stable_step.h"

namespace magfsi::lammps {

struct Substeps {
    int count = 1;
    double coupled_step_s = 0;
    double lammps_step_s = 0;
    // Stable steps of the lattice and of the immersed-boundary force (0 without fluid).
    // They are infinite where no node can move.
    double elastic_limit_s = 0;
    double drag_limit_s = 0;
};

// LAMMPS steps of a run in which the number of them in a coupled step may change.
struct StepCount {
    std::int64_t before = 0;  // done by the coupled step `since`
    std::int64_t since = 0;
    int fewest = 0;             // in any coupled step
    std::int64_t at_start = 0;  // done when this run began

    std::int64_t until(std::int64_t coupled_step, int count) const {
        return before + (coupled_step - since) * count;
    }
    // From this coupled step on there is another number of them.
    void change(std::int64_t coupled_step, int until_now) {
        before = until(coupled_step, until_now);
        since = coupled_step;
    }
    // For checkpoints.
    std::vector<double> carried(std::int64_t coupled_step, int count) const {
        return {1.0 * count, static_cast<double>(until(coupled_step, count)),
                1.0 * fewest};
    }
};

// Without a coupled step in the scene (no fluid, no time.step) one coupled step is one
// LAMMPS step. For equilibria a coupled step is a point of the path, with as many LAMMPS
// steps as it takes (count is 0). Throws std::invalid_argument when coupling.substeps
// asks for fewer than are stable, naming both.
Substeps choose_substeps(const scene::Scene& scene);

// Keeps LAMMPS's steps below the limit of the bodies as they are deformed: where it
// falls, a coupled step gets more of them.
class StepGuard {
  public:
    // bodies: with the inertia that their nodes have. Only the root (comm's rank 0)
    // holds their elements.
    StepGuard(const std::vector<structure::Body>& bodies, const Substeps& substeps,
              MPI_Comm comm);

    // A check costs about as much as a LAMMPS step: one in this many coupled steps.
    std::int64_t every() const { return every_; }

    struct Result {
        int factor = 1;  // more steps than now
        double limit_s = 0;
    };
    // state: on the root. Collective. Throws coupler::Diverged where more than 16 times
    // the steps of the start would be needed.
    Result check(const bodies::NodalState& state, const Substeps& now) const;

  private:
    MPI_Comm comm_;
    Substeps start_;
    std::int64_t every_ = 1;
    std::vector<structure::CurrentStep> elements_;
    std::vector<std::size_t> first_node_;
};

}  // namespace magfsi::lammps
