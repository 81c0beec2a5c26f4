// How many LAMMPS steps make one coupled step.
#pragma once

#include <cstdint>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::lammps {

struct Substeps {
    int count = 1;
    double coupled_step_s = 0;
    double lammps_step_s = 0;
    double elastic_limit_s = 0;  // stable step of the lattice
    double drag_limit_s = 0;     // of the immersed-boundary force; 0 without fluid
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
// steps as it takes (count is 0). Throws scene::SceneError-like std::invalid_argument
// when coupling.substeps asks for fewer than are stable, naming both.
Substeps choose_substeps(const scene::Scene& scene);

}  // namespace magfsi::lammps
