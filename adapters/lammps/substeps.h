// How many LAMMPS steps make one coupled step.
#pragma once

#include "coupler/scene/scene.h"

namespace magfsi::lammps {

struct Substeps {
    int count = 1;
    double coupled_step_s = 0;
    double lammps_step_s = 0;
    double elastic_limit_s = 0;  // stable step of the lattice
    double drag_limit_s = 0;     // of the immersed-boundary force; 0 without fluid
};

// Without a coupled step in the scene (no fluid, no time.step) one coupled step is one
// LAMMPS step. For equilibria a coupled step is a point of the path, with as many LAMMPS
// steps as it takes (count is 0). Throws scene::SceneError-like std::invalid_argument
// when coupling.substeps asks for fewer than are stable, naming both.
Substeps choose_substeps(const scene::Scene& scene);

}  // namespace magfsi::lammps
