// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/bodies/field_work.h"

#include <utility>

namespace magfsi::bodies {

using structure::Vec3;

FieldForces::FieldForces(const structure::Body& body,
                         const std::optional<structure::GradientInput>& gradient)
    : charge_a_m_(structure::nodal_charges(body.mesh.nodes, body.mesh.elements,
                                           body.magnetization_a_m)) {
    if (!gradient || body.magnetization_a_m.empty()) return;
    gradient_.emplace(*gradient);
    elements_ = body.mesh.elements;
    gradient_elements_ =
        structure::gradient_elements(body.mesh.nodes, elements_, body.magnetization_a_m);
}

std::vector<Vec3> FieldForces::forces_n(std::span<const Vec3> nodes_m,
                                        const Vec3& field_t) const {
    std::vector<Vec3> out(nodes_m.size());
    for (std::size_t n = 0; n < out.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) out[n][d] = charge_a_m_[n] * field_t[d];
    }
    if (gradient_)
        structure::add_gradient_forces(gradient_elements_, elements_, *gradient_,
                                       nodes_m.front().data(), out.front().data());
    return out;
}

FieldWork::FieldWork(const structure::Body& body, std::vector<Vec3> placed_m, bool let_go,
                     const std::optional<structure::GradientInput>& gradient)
    : forces_(body, gradient),
      nodes_m_(std::move(placed_m)),
      force_n_(nodes_m_.size(), Vec3{}),
      let_go_(let_go) {}

void FieldWork::move_to(std::span<const Vec3> nodes_m, const Vec3& field_t) {
    if (std::exchange(let_go_, false)) force_n_ = forces_.forces_n(nodes_m_, field_t);
    const std::vector<Vec3> before_m = nodes_m_, before_n = force_n_;
    nodes_m_.assign(nodes_m.begin(), nodes_m.end());
    force_n_ = forces_.forces_n(nodes_m_, field_t);
    for (std::size_t n = 0; n < nodes_m.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d)
            work_j_ += 0.5 * (before_n[n][d] + force_n_[n][d]) *
                       (nodes_m_[n][d] - before_m[n][d]);
    }
}

bool is_let_go(const structure::Body& body, const structure::Placement& initial) {
    return (body.clamps.empty() && body.rollers.empty()) || initial.relaxed;
}

}  // namespace magfsi::bodies
