// SPDX-License-Identifier: GPL-2.0-or-later
// Equilibria by damped motion: the independent path beside Newton's method, and the only
// one with friction and contact.
#pragma once

#include <cstdint>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "adapters/solvers/lammps/engine.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// Drag that damps a body's lowest bending frequency critically [1/s]: twice
// omega = (b / L)^2 sqrt(E h^2 / (12 rho)), b = 1.875 for a clamped beam and 4.730 for a
// free one, L and h the largest and smallest extents of the mesh; the lowest over all
// bodies.
double critical_drag_rate_1_s(const std::vector<structure::Body>& bodies);

// Adds to the input what a search for rest needs beyond the scene: critical drag unless
// the scene has damping, fix quiet, and the field held at its value at time 0.
void prepare_for_rest(structure::LammpsInput& input, const scene::Scene& scene);

// Load [N] that forces are compared with where there is no load: G h^2 times a strain of
// 0.001, G the shear modulus and h the smallest extent; the least over all bodies and
// their materials.
double stiffness_load_n(const std::vector<structure::Body>& bodies);

// Integrates the damped motion until the largest nodal force is below the scene's
// tolerance times the largest nodal load.
class RestFinder {
  public:
    // Keeps references to engine and scene. The engine's input must be that of
    // prepare_for_rest; step_s: its time step.
    RestFinder(Engine& engine, const scene::Scene& scene, const bodies::Solids& solids,
               double step_s);

    // Finds the equilibrium under the loads at this time on the path, from the present
    // positions. Throws coupler::Diverged, with the ratio of force and load that was
    // reached, if the bodies do not come to rest. Collective.
    void find(double time_s);
    std::int64_t steps() const { return steps_; }  // LAMMPS steps so far

  private:
    void hold_field(double time_s);
    double unrest();

    Engine& engine_;
    const scene::Scene& scene_;
    std::int64_t max_steps_ = 0;  // limit at one point of the path
    std::int64_t steps_ = 0;
    double stiffness_load_n_ = 0;
    double largest_load_n_ = 0;  // largest nodal load so far
};

}  // namespace magfsi::lammps
