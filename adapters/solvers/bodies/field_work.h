// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of the magnetic field on a body, and their work along a path of equilibria.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"
#include "structure/magnetics/magnetic_forces.h"
#include "structure/magnetics/turned_moments.h"

namespace magfsi::bodies {

// Forces of the applied field on all nodes of one body: q_a B of the uniform field, with
// the magnetic charges q_a of the nodes (docs/theory.md, eqs. 5-6), plus the forces of a
// field gradient and of field sources (structure/magnetics/magnetic_forces.h). The
// bodies' own field (dipoles) is not included.
class FieldForces {
  public:
    // Copies what it needs of both. A body without magnetisation feels no force.
    FieldForces(const structure::Body& body, const scene::MagneticField& field);

    std::size_t nodes() const { return charge_a_m_.size(); }  // number of nodes

    // Force on each node [N]. nodes_m: present positions of the body's nodes [m], at
    // least one. uniform_t: uniform flux density [T] that replaces the scene's law, for
    // instance one that a controller has set; gradient and sources remain the scene's.
    // Moves the sources to time_s: not to be called by two threads at once.
    std::vector<structure::Vec3> at(
        std::span<const structure::Vec3> nodes_m, double time_s,
        const std::optional<structure::Vec3>& uniform_t = {}) const;

  private:
    scene::MagneticField field_;
    std::vector<double> charge_a_m_;  // magnetic charge q_a of each node [A m]
    std::vector<structure::Hexahedron> elements_;
    // Elements of a magnetisation that follows the rotation, whose nodes have no charges
    std::vector<structure::TurnedElement> turned_;
    std::optional<structure::FieldGradient> gradient_;
    // One entry for each element; empty if the field has no gradient.
    std::vector<structure::GradientElement> gradient_elements_;
    mutable std::optional<structure::SourceField> sources_;
    // Moment matrix of each element [A m2]; empty if the field has no sources.
    std::vector<structure::Matrix8> moments_;
};

// Work of the field on one body along a path of equilibria, by the trapezium rule:
//   sum over the path of (F_before + F_after)/2 . (x_after - x_before) [J].
// It depends on the equilibria alone and not on the motion that a solver takes from one
// to the next (docs/energy_audit.md).
class FieldWork {
  public:
    // placed_m: positions of the nodes [m] before any load acts. let_go: true if the body
    // is released in the field of the first equilibrium, which then acts at full strength
    // from the start; false if the field is raised from zero on the way to it.
    FieldWork(const structure::Body& body, std::vector<structure::Vec3> placed_m,
              bool let_go, const scene::MagneticField& field);

    // Adds the work from the equilibrium before to the one with these positions [m].
    void move_to(std::span<const structure::Vec3> nodes_m, double time_s);
    double work_j() const { return work_j_; }  // sum since the start

  private:
    FieldForces forces_;
    std::vector<structure::Vec3> nodes_m_, force_n_;  // at the last equilibrium
    bool let_go_;  // true until the first equilibrium of a released body is reached
    double work_j_ = 0;
};

// True if a body is released at the start of its path: no clamp or roller holds it, or it
// starts in a relaxed shape.
bool is_let_go(const structure::Body& body, const structure::Placement& initial);

}  // namespace magfsi::bodies
