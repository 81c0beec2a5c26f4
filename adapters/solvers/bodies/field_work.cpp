// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/field_work.h"

#include <algorithm>
#include <utility>

#include "structure/lammps/field_program.h"

namespace magfsi::bodies {

FieldForces::FieldForces(const structure::Body& body, const scene::MagneticField& field)
    : field_(field),
      charge_a_m_(structure::nodal_charges(body.mesh.nodes, body.mesh.elements,
                                           body.magnetization_a_m)),
      elements_(body.mesh.elements) {
    if (body.magnetization_a_m.empty()) return;
    if (structure::is_turned(body)) {
        turned_ = structure::turned_elements(body.mesh.nodes, elements_,
                                             body.magnetization_a_m);
        std::ranges::fill(charge_a_m_, 0.0);
    }
    if (field.gradient) {
        gradient_.emplace(*field.gradient);
        gradient_elements_ = structure::gradient_elements(body.mesh.nodes, elements_,
                                                          body.magnetization_a_m);
    }
    if (field.sources.empty()) return;
    sources_.emplace(field.sources);
    moments_ =
        structure::moment_elements(body.mesh.nodes, elements_, body.magnetization_a_m);
}

std::vector<Vec3> FieldForces::at(std::span<const Vec3> nodes_m, double time_s,
                                  const std::optional<Vec3>& uniform_t) const {
    const Vec3 field_t = uniform_t ? *uniform_t : structure::field_at(field_, time_s);
    std::vector<Vec3> out(nodes_m.size());
    for (std::size_t n = 0; n < out.size(); ++n) out[n] = charge_a_m_[n] * field_t;
    const double* x = nodes_m.front().data();
    if (!turned_.empty())
        structure::add_turned_forces(turned_, elements_, Eigen::Vector3d(field_t.data()),
                                     x, out.front().data());
    if (gradient_)
        structure::add_gradient_forces(gradient_elements_, elements_, *gradient_, x,
                                       out.front().data());
    if (!sources_) return out;
    sources_->set_time(time_s);
    std::vector<structure::FieldSample> samples;
    for (const Vec3& node : nodes_m) samples.push_back(sources_->sample(node));
    structure::add_source_forces(moments_, elements_, samples, x, out.front().data());
    return out;
}

FieldWork::FieldWork(const structure::Body& body, std::vector<Vec3> placed_m, bool let_go,
                     const scene::MagneticField& field)
    : forces_(body, field),
      nodes_m_(std::move(placed_m)),
      force_n_(nodes_m_.size(), Vec3{}),
      let_go_(let_go) {}

// The force before the first step is zero, or for a released body that of the first
// equilibrium's field in the initial positions.
void FieldWork::move_to(std::span<const Vec3> nodes_m, double time_s) {
    if (std::exchange(let_go_, false)) force_n_ = forces_.at(nodes_m_, time_s);
    const std::vector<Vec3> before_m = nodes_m_, before_n = force_n_;
    nodes_m_.assign(nodes_m.begin(), nodes_m.end());
    force_n_ = forces_.at(nodes_m_, time_s);
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
