#include "adapters/bodies/probe_row.h"

#include <algorithm>

#include "adapters/bodies/body_mesh.h"
#include "adapters/bodies/body_part.h"
#include "adapters/bodies/scene_to_body.h"

namespace magfsi::bodies {

namespace {

void add(std::vector<double>& row, const Vec3& v) {
    row.insert(row.end(), v.begin(), v.end());
}

void add_quantity(std::vector<double>& row, scene::BodyQuantity quantity,
                  const BodyNodes& body, const NodalState& state,
                  const BodyLoads& loads) {
    switch (quantity) {
        case scene::BodyQuantity::com:
            return add(row, centre_of_mass(body, state));
        case scene::BodyQuantity::speed:
            return add(row, mean_velocity(body, state));
        case scene::BodyQuantity::shape: {
            const Shape s = shape(body, state);
            return add(row, {s.end_to_end_m, s.mid_rise_m, s.bend_rad});
        }
        case scene::BodyQuantity::max_displacement:
            return row.push_back(max_displacement_m(body, state));
        case scene::BodyQuantity::fluid_force:
            return add(row, loads.fluid_force_n);
        case scene::BodyQuantity::energy:
            return add(row, {loads.energy_elastic_j, kinetic_energy_j(body, state),
                             loads.work_magnetic_j});
    }
}

}  // namespace

ProbeRow::ProbeRow(const scene::Scene& scene, const std::vector<structure::Body>& bodies,
                   const NodalState& start)
    : scene_(scene) {
    field_ = scene.magnetic_field;
    std::size_t first = 0;
    for (const structure::Body& solid : bodies) {
        BodyNodes body;
        body.first = first;
        body.count = solid.mesh.nodes.size();
        body.centre_line = solid.mesh.centre_line;
        const auto from = start.position_m.begin() + static_cast<std::ptrdiff_t>(first);
        body.start_m.assign(from, from + static_cast<std::ptrdiff_t>(body.count));
        first += body.count;
        bodies_.push_back(std::move(body));
    }
    if (!scene.probes) return;
    for (const scene::PointProbe& probe : scene.probes->points) {
        const auto found =
            std::ranges::find(scene.bodies, probe.body, &scene::Body::name);
        const auto b = static_cast<std::size_t>(found - scene.bodies.begin());
        Point point{locate(*found, bodies[b].mesh, probe.at_m), bodies_[b].first, {}};
        point.start_m = position(point.at, start, point.first_node);
        points_.push_back(point);
    }
    for (const scene::IntegralProbe& integral : scene.probes->integrals) {
        const auto* part = std::get_if<scene::BodyPart>(&integral.over);
        if (!part) continue;
        const auto found =
            std::ranges::find(scene.bodies, part->body, &scene::Body::name);
        const auto b = static_cast<std::size_t>(found - scene.bodies.begin());
        parts_.push_back({bodies_[b].first,
                          node_shares(elements_of(*part, bodies[b].mesh), bodies[b].mesh),
                          bodies_[b].start_m});
    }
}

bool ProbeRow::wants(const scene::Scene& scene, scene::BodyQuantity quantity) {
    return scene.probes && std::ranges::find(scene.probes->bodies, quantity) !=
                               scene.probes->bodies.end();
}

std::vector<double> ProbeRow::values(double time_s, const NodalState& state,
                                     const std::vector<BodyLoads>& loads,
                                     const std::vector<Vec3>& force_on_parts_n) const {
    std::vector<double> row;
    if (field_) row.push_back(structure::polar_field_at(*field_, time_s).magnitude_t);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        for (const auto quantity : scene_.probes->bodies)
            add_quantity(row, quantity, bodies_[b], state, loads[b]);
    }
    for (const Point& point : points_) {
        const Vec3 now = position(point.at, state, point.first_node);
        add(row, now);
        for (std::size_t d = 0; d < 3; ++d) row.push_back(now[d] - point.start_m[d]);
    }
    add_parts(row, state, force_on_parts_n);
    return row;
}

void ProbeRow::add_parts(std::vector<double>& row, const NodalState& state,
                         const std::vector<Vec3>& force_n) const {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const Part& part = parts_[p];
        double mass = 0;
        Vec3 moved{}, momentum{};
        for (std::size_t i = 0; i < part.share.size(); ++i) {
            const std::size_t n = part.first_node + i;
            const double m = part.share[i] * state.mass_kg[n];
            mass += m;
            for (std::size_t d = 0; d < 3; ++d) {
                moved[d] += m * (state.position_m[n][d] - part.start_m[i][d]);
                momentum[d] += m * state.velocity_m_s[n][d];
            }
        }
        for (double& u : moved) u /= mass;
        add(row, moved);
        add(row, momentum);
        if (scene_.fluid) add(row, force_n.at(p));
    }
}

}  // namespace magfsi::bodies
