// SPDX-License-Identifier: GPL-2.0-or-later
// The number of LAMMPS steps in a coupled step, at the start and as bodies deform.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/nodal_state.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/body.h"
#include "structure/lammps/script.h"
#include "structure/lattice/stable_step.h"

namespace magfsi::lammps {

struct Substeps {
    int count = 1;  // LAMMPS steps in a coupled step; 0 for equilibria
    double coupled_step_s = 0;
    double lammps_step_s = 0;
    // Stable steps of the lattice and of the immersed-boundary force (0 without fluid).
    // They are infinite where no node can move.
    double elastic_limit_s = 0;
    double drag_limit_s = 0;
};

// Count of LAMMPS steps in a run in which their number in a coupled step may change.
struct StepCount {
    std::int64_t before = 0;    // LAMMPS steps done by the coupled step `since`
    std::int64_t since = 0;     // coupled step of the last change
    int fewest = 0;             // smallest number in a coupled step of the run
    std::int64_t at_start = 0;  // LAMMPS steps done when this run began

    // LAMMPS steps done by a coupled step. count: their present number in each.
    std::int64_t until(std::int64_t coupled_step, int count) const {
        return before + (coupled_step - since) * count;
    }
    // Notes that the number changes at this coupled step; until_now: the number before.
    void change(std::int64_t coupled_step, int until_now) {
        before = until(coupled_step, until_now);
        since = coupled_step;
    }
    // The three numbers that a checkpoint keeps: present number in a coupled step, steps
    // done, smallest number.
    std::vector<double> carried(std::int64_t coupled_step, int count) const {
        return {1.0 * count, static_cast<double>(until(coupled_step, count)),
                1.0 * fewest};
    }
};

// The steps at the start of a run. In a scene without a coupled step (no fluid, no
// time.step) a coupled step is one LAMMPS step. For equilibria it is a point of the path
// with as many LAMMPS steps as it takes to come to rest, and count is 0. Throws
// std::invalid_argument if coupling.substeps asks for fewer than are stable, naming both.
// input: to_lammps_input of the scene.
Substeps choose_substeps(const scene::Scene& scene, const structure::LammpsInput& input);
// The same from the bodies, kept under the scene's hash: it is expensive, and the command
// explain asks for it repeatedly.
Substeps choose_substeps(const scene::Scene& scene, const bodies::Solids& solids);

// "take more coupling.substeps, ...": what helps bodies that become unstable, in the keys
// that this scene may have. Equilibria have no step of their own.
std::string advice_if_unstable(const scene::Scene& scene);

// Keeps LAMMPS's step below the stable step of the bodies in their present shape: where
// it falls, a coupled step gets more LAMMPS steps.
class StepGuard {
  public:
    // bodies: with the densities that LAMMPS integrates (bodies_in_fluid); substeps:
    // those at the start of the run. Only the root (comm's rank 0) holds their elements.
    StepGuard(const std::vector<structure::Body>& bodies, const Substeps& substeps,
              MPI_Comm comm);

    // Interval of the checks in coupled steps. A check costs about as much as one LAMMPS
    // step and is due after a hundred of them.
    std::int64_t every() const { return every_; }

    struct Result {
        int factor = 1;      // factor by which the number of LAMMPS steps must grow
        double limit_s = 0;  // present stable step
    };
    // state: the present nodes, on the root; now: the present steps. Collective. Throws
    // coupler::Diverged where more than 16 times the steps of the start would be needed.
    Result check(const bodies::NodalState& state, const Substeps& now) const;

  private:
    MPI_Comm comm_;
    Substeps start_;
    std::int64_t every_ = 1;
    std::vector<structure::CurrentStep> elements_;  // one entry for each body
    std::vector<std::string> names_;                // of the bodies
    // Number of each body's node 0 among those of all bodies; last the number of nodes.
    std::vector<std::size_t> first_node_;
};

}  // namespace magfsi::lammps
