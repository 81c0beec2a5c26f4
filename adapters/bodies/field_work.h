// SPDX-License-Identifier: GPL-2.0-or-later
// Work of the magnetic field along a path of equilibria.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::bodies {

// Of the field on the nodes of a body: q_a B of a uniform field, q_a the nodes' charges,
// and those of a gradient.
class FieldForces {
  public:
    explicit FieldForces(
        const structure::Body& body,
        const std::optional<structure::GradientInput>& gradient = std::nullopt);

    std::size_t nodes() const { return charge_a_m_.size(); }
    std::vector<structure::Vec3> forces_n(std::span<const structure::Vec3> nodes_m,
                                          const structure::Vec3& field_t) const;

  private:
    std::vector<double> charge_a_m_;
    std::optional<structure::FieldGradient> gradient_;
    std::vector<structure::GradientElement> gradient_elements_;  // none without it
    std::vector<structure::Hexahedron> elements_;
};

// sum over the path of (F_before + F_after)/2 . (x_after - x_before), F the field's
// forces on the nodes. A property of the equilibria, whatever motion leads from one to
// the next.
class FieldWork {
  public:
    // Where the body is before any load. `let_go`: moves to the first equilibrium in the
    // field at full strength; else the field is raised from zero on the way.
    FieldWork(const structure::Body& body, std::vector<structure::Vec3> placed_m,
              bool let_go,
              const std::optional<structure::GradientInput>& gradient = std::nullopt);

    void move_to(std::span<const structure::Vec3> nodes_m,
                 const structure::Vec3& field_t);
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
