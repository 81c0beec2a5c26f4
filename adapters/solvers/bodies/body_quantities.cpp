// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/body_quantities.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace magfsi::bodies {

Vec3 position(const structure::MaterialPoint& point, const std::vector<Vec3>& nodes_m,
              std::size_t first_node) {
    Vec3 at{};
    for (std::size_t a = 0; a < 8; ++a) {
        const std::size_t node = point.node[a];
        at += point.weight[a] * nodes_m[first_node + node];
    }
    return at;
}

Vec3 mass_weighted_mean(const BodySample& body, const std::vector<Vec3>& field) {
    double mass = 0;
    Vec3 sum{};
    for (std::size_t i = body.first; i < body.first + body.count; ++i) {
        mass += body.nodes.mass_kg[i];
        sum += body.nodes.mass_kg[i] * field[i];
    }
    return sum / mass;
}

namespace {

double kinetic_energy_j(const BodySample& body) {
    double energy = 0;
    for (std::size_t i = body.first; i < body.first + body.count; ++i) {
        const Vec3& v = body.nodes.velocity_m_s[i];
        energy += 0.5 * body.nodes.mass_kg[i] * dot(v, v);
    }
    return energy + body.loads.kinetic_beyond_nodes_j;
}

// Torque of the fluid about the centre of mass, from the one about the origin of space.
Vec3 fluid_torque_n_m(const BodySample& body) {
    return body.loads.fluid_torque_n_m -
           cross(mass_weighted_mean(body, body.nodes.position_m),
                 body.loads.fluid_force_n);
}

// Largest distance of a node from its place at step 0, rigid motion included.
double max_displacement_m(const BodySample& body) {
    double largest = 0;
    for (std::size_t i = 0; i < body.count; ++i) {
        largest =
            std::max(largest, structure::distance_m(body.nodes.position_m[body.first + i],
                                                    body.start_m[i]));
    }
    return largest;
}

// Direction from a to b in the x-z plane [rad], 0 along x and pi/2 along z.
double heading(const Vec3& a, const Vec3& b) {
    return std::atan2(b[2] - a[2], b[0] - a[0]);
}

// Three measures of the centre line, with directions in the x-z plane: distance of its
// ends [m]; height of its middle over the middle of the chord, along the normal of the
// line there [m] (positive: ends down, as in C; negative: V); angle from the tangent at
// the left end to that at the right end [rad] (positive: ends up). The angle is summed
// from point to point and may exceed a full turn. Zeros if the centre line has fewer than
// four points.
Vec3 shape(const BodySample& body) {
    std::vector<Vec3> line;
    for (const auto& point : body.centre_line)
        line.push_back(position(point, body.nodes.position_m, body.first));
    if (line.size() < 4) return {};
    const Vec3& left = line.front();
    const Vec3& right = line.back();
    const std::size_t middle = line.size() / 2;
    const double tangent =
        heading(line[middle - 1], line[middle + 1 < line.size() ? middle + 1 : middle]);
    const double dx = line[middle][0] - 0.5 * (left[0] + right[0]);
    const double dz = line[middle][2] - 0.5 * (left[2] + right[2]);
    const double mid_rise_m = -std::sin(tangent) * dx + std::cos(tangent) * dz;
    double bend_rad = 0;
    double before = heading(line[0], line[1]);
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const double now = heading(line[i], line[i + 1]);
        bend_rad += std::remainder(now - before, 2 * std::numbers::pi);
        before = now;
    }
    return {structure::distance_m(left, right), mid_rise_m, bend_rad};
}

Row row_of(const Vec3& v) {
    return {v.begin(), v.end()};
}

// Force of all contact on a body, and its torque about the centre of mass.
Row contact_load(const BodySample& body) {
    const Vec3 centre = mass_weighted_mean(body, body.nodes.position_m);
    Vec3 force{}, torque{};
    for (std::size_t i = 0; i < body.loads.contact_n.size(); ++i) {
        force += body.loads.contact_n[i];
        torque += cross(body.nodes.position_m[body.first + i] - centre,
                        body.loads.contact_n[i]);
    }
    Row row = row_of(force);
    row.insert(row.end(), torque.begin(), torque.end());
    return row;
}

}  // namespace

const BodyProbe& body_probe(scene::BodyQuantity quantity) {
    using Q = scene::BodyQuantity;
    using Body = const BodySample&;
    static const BodyProbe all[] = {
        {Q::com,
         {"com_x[m]", "com_y[m]", "com_z[m]"},
         Load::none,
         [](Body b) { return row_of(mass_weighted_mean(b, b.nodes.position_m)); }},
        {Q::speed,
         {"speed_x[m/s]", "speed_y[m/s]", "speed_z[m/s]"},
         Load::none,
         [](Body b) { return row_of(mass_weighted_mean(b, b.nodes.velocity_m_s)); }},
        {Q::shape,
         {"end_to_end[m]", "mid_rise[m]", "bend[rad]"},
         Load::none,
         [](Body b) { return row_of(shape(b)); }},
        {Q::max_displacement,
         {"max_displacement[m]"},
         Load::none,
         [](Body b) { return Row{max_displacement_m(b)}; }},
        {Q::fluid_force,
         {"fluid_force_x[N]", "fluid_force_y[N]", "fluid_force_z[N]"},
         Load::fluid_force,
         [](Body b) { return row_of(b.loads.fluid_force_n); }},
        {Q::fluid_torque,
         {"fluid_torque_x[N m]", "fluid_torque_y[N m]", "fluid_torque_z[N m]"},
         Load::fluid_torque,
         [](Body b) { return row_of(fluid_torque_n_m(b)); }},
        {Q::reaction_force, {}, Load::support, nullptr},  // add_reactions
        {Q::magnetic_load, {}, Load::none, nullptr},      // add_magnetic_load
        {Q::contact_load,
         {"contact_force_x[N]", "contact_force_y[N]", "contact_force_z[N]",
          "contact_torque_x[N m]", "contact_torque_y[N m]", "contact_torque_z[N m]"},
         Load::contact,
         contact_load},
        {Q::rigid_motion, {}, Load::none, nullptr},  // add_rigid_motion
        {Q::energy,
         {"energy_elastic[J]", "energy_kinetic[J]", "work_magnetic[J]"},
         Load::energies,
         [](Body b) {
             return Row{b.loads.energy_elastic_j, kinetic_energy_j(b),
                        b.loads.work_magnetic_j};
         }},
    };
    return *std::ranges::find(all, quantity, &BodyProbe::quantity);
}

}  // namespace magfsi::bodies
