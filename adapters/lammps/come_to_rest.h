// SPDX-License-Identifier: GPL-2.0-or-later
// Equilibria by damped motion: the independent path beside Newton's method, and the only
// one with friction and contact.
#pragma once

#include <cstdint>

#include "adapters/lammps/engine.h"
#include "adapters/scene/scene.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// Drag that damps a body's lowest bending frequency critically [1/s]: twice
// omega = (b / L)^2 sqrt(E h^2 / (12 rho)), b = 1.875 for a clamped beam and 4.730 for a
// free one, L and h the largest and smallest extents of the mesh; the lowest over all
// bodies.
double critical_drag_rate_1_s(const std::vector<structure::Body>& bodies);

// What the input of such a run needs beyond the scene: drag, the measure of rest, and the
// field at the start of the path held still.
void prepare_for_rest(structure::LammpsInput& input, const scene::Scene& scene);

// Stands for the largest nodal load where there is none yet: a small strain's force on
// the square of the smallest extent; the least over all bodies [N].
double stiffness_load_n(const std::vector<structure::Body>& bodies);

// Runs until the largest nodal force is below the tolerance times the largest nodal load.
class RestFinder {
  public:
    RestFinder(Engine& engine, const scene::Scene& scene, double step_s);

    // Under the loads of this time on the path. Throws coupler::Diverged, with how far it
    // was, if rest is not found. Collective.
    void find(double time_s);
    std::int64_t steps() const { return steps_; }  // so far

  private:
    void hold_field(double time_s);
    double unrest();  // largest nodal force over the load it is measured by

    Engine& engine_;
    const scene::Scene& scene_;
    std::int64_t max_steps_ = 0;  // at one point of the path
    std::int64_t steps_ = 0;
    double stiffness_load_n_ = 0;
    double largest_load_n_ = 0;  // so far
};

}  // namespace magfsi::lammps
