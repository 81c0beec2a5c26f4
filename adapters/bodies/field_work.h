// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of the magnetic field on a body, and their work along a path of equilibria.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::bodies {

// On all nodes, of all that the scene's field is made of: q_a B of a uniform field, q_a
// the nodes' charges, and those of a gradient and of sources.
class FieldForces {
  public:
    FieldForces(const structure::Body& body, const scene::MagneticField& field);

    std::size_t nodes() const { return charge_a_m_.size(); }
    // uniform_t: in place of the scene's law.
    std::vector<structure::Vec3> at(
        std::span<const structure::Vec3> nodes_m, double time_s,
        const std::optional<structure::Vec3>& uniform_t = {}) const;

  private:
    scene::MagneticField field_;
    std::vector<double> charge_a_m_;
    std::vector<structure::Hexahedron> elements_;
    std::optional<structure::FieldGradient> gradient_;
    std::vector<structure::GradientElement> gradient_elements_;  // none without it
    mutable std::optional<structure::SourceField> sources_;
    std::vector<structure::Matrix8> moments_;  // none without sources
};

// sum over the path of (F_before + F_after)/2 . (x_after - x_before): a property of the
// equilibria, whatever motion leads from one to the next.
class FieldWork {
  public:
    // Where the body is before any load. `let_go`: moves to the first equilibrium in the
    // field at full strength; else the field is raised from zero on the way.
    FieldWork(const structure::Body& body, std::vector<structure::Vec3> placed_m,
              bool let_go, const scene::MagneticField& field);

    void move_to(std::span<const structure::Vec3> nodes_m, double time_s);
    double work_j() const { return work_j_; }

  private:
    FieldForces forces_;
    std::vector<structure::Vec3> nodes_m_, force_n_;
    bool let_go_;
    double work_j_ = 0;
};

// Whether a body is let go at the start of its path: one that nothing holds, or a relaxed
// one.
bool is_let_go(const structure::Body& body, const structure::Placement& initial);

}  // namespace magfsi::bodies
