#include "adapters/bodies/field_work.h"

#include <utility>

#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::bodies {

FieldWork::FieldWork(const structure::Body& body, std::vector<structure::Vec3> placed_m,
                     bool let_go)
    : charge_a_m_(structure::nodal_charges(body.mesh.nodes, body.mesh.elements,
                                           body.magnetization_a_m)),
      nodes_m_(std::move(placed_m)),
      let_go_(let_go) {}

void FieldWork::move_to(std::span<const structure::Vec3> nodes_m,
                        const structure::Vec3& field_t) {
    if (std::exchange(let_go_, false)) field_t_ = field_t;
    for (std::size_t n = 0; n < nodes_m.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            work_j_ += 0.5 * charge_a_m_[n] * (field_t_[d] + field_t[d]) *
                       (nodes_m[n][d] - nodes_m_[n][d]);
            nodes_m_[n][d] = nodes_m[n][d];
        }
    }
    field_t_ = field_t;
}

bool is_let_go(const structure::Body& body, const structure::Placement& initial) {
    return (body.clamps.empty() && body.rollers.empty()) || initial.relaxed;
}

}  // namespace magfsi::bodies
