// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/probe_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "adapters/scene/fault.h"
#include "adapters/scene/reader.h"
#include "adapters/solvers/bodies/body_quantities.h"
#include "adapters/solvers/bodies/field_work.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/lammps/field_program.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::bodies {

namespace {

void add(Row& row, const Vec3& v) {
    row.insert(row.end(), v.begin(), v.end());
}

// Fraction of each node's mass that belongs to the marked elements, by volumes at rest;
// 1 at every node if all elements are marked. In a body of several materials it is a
// fraction of the volume around the node.
std::vector<double> node_shares(const std::vector<bool>& elements,
                                const structure::Mesh& mesh) {
    std::vector<double> mine(mesh.nodes.size()), all(mine);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const auto x = structure::gather(mesh.nodes, mesh.elements[e]);
        const double volume = structure::integrate_hexahedron(x, e).volume;
        for (const int node : mesh.elements[e]) {
            const std::size_t n = node;
            all[n] += volume;
            if (elements[e]) mine[n] += volume;
        }
    }
    for (std::size_t n = 0; n < mine.size(); ++n)
        mine[n] = all[n] > 0 ? mine[n] / all[n] : 0;
    return mine;
}

}  // namespace

bool needs(const scene::Scene& scene, Load load) {
    if (!scene.probes) return false;
    return std::ranges::any_of(scene.probes->bodies, [load](auto quantity) {
        const Load its = body_probe(quantity).needs;
        return its == load || (its == Load::fluid_torque && load == Load::fluid_force);
    });
}

std::vector<bool> elements_of(const scene::BodyPart& part, const structure::Mesh& mesh) {
    std::vector<bool> in(mesh.elements.size(), !part.box_m);
    if (!part.box_m) return in;
    const auto& [low, high] = *part.box_m;
    for (std::size_t e = 0; e < in.size(); ++e) {
        in[e] = true;
        for (std::size_t d = 0; d < 3; ++d) {
            double centre = 0;
            for (const int node : mesh.elements[e]) centre += mesh.nodes[node][d] / 8;
            in[e] = in[e] && centre >= low[d] && centre <= high[d];
        }
    }
    if (std::ranges::find(in, true) == in.end())
        throw std::invalid_argument(fmt::format(
            "probes.integrals: no element of body '{}' has its centre in the box, which "
            "reaches from ({:.6g}) m to ({:.6g}) m in the body's frame; make it larger",
            part.body, fmt::join(low, ", "), fmt::join(high, ", ")));
    return in;
}

std::size_t column_of(const std::vector<std::string>& columns,
                      const scene::Control& control, std::size_t i) {
    const std::string& name = control.probes[i];
    std::vector<std::string> bare;
    for (const std::string& column : columns)
        bare.push_back(column.substr(0, column.find('[')));
    auto at = std::ranges::find(columns, name);
    if (at == columns.end())
        at = columns.begin() + (std::ranges::find(bare, name) - bare.begin());
    if (at == columns.end()) {
        const std::string near = scene::did_you_mean(name, bare);
        throw scene::SceneError(
            fmt::format("{}: found {} in control.probes; allowed are columns of "
                        "probes.csv, with or without their unit: {}{}",
                        control.probe_places[i], scene::in_quotes(name),
                        fmt::join(columns, ", "), near.empty() ? "" : "; " + near));
    }
    return at - columns.begin();
}

// The columns of the field read field_, so that set_field acts on later rows.
ProbeRow::ProbeRow(const scene::Scene& scene, const std::vector<structure::Body>& bodies,
                   const NodalState& start)
    : start_m_(start.position_m) {
    if (!scene.probes) return;
    // Sources alone have no uniform part, unless a controller adds one.
    if (scene.magnetic_field && (scene.magnetic_field->uniform ||
                                 !scene.magnetic_field->plus.empty() || scene.control)) {
        field_ = *scene.magnetic_field;
        groups_.push_back({{"field[T]", "field_x[T]", "field_y[T]", "field_z[T]"},
                           [this](const ProbeSample& sample, Row& row) {
                               row.push_back(
                                   structure::field_magnitude_at(field_, sample.time_s));
                               add(row, structure::field_at(field_, sample.time_s));
                           }});
    }
    std::vector<std::size_t> first_node;
    std::size_t first = 0;
    for (const structure::Body& body : bodies) {
        first_node.push_back(first);
        first += body.mesh.nodes.size();
    }
    const auto number = [&](const std::string& name) {
        return static_cast<std::size_t>(
            std::ranges::find(scene.bodies, name, &scene::Body::name) -
            scene.bodies.begin());
    };
    rigid_parts_ = rigid_parts_of(bodies);
    for (std::size_t b = 0; b < bodies.size(); ++b)
        add_body(scene, b, bodies[b], first_node[b]);
    for (const scene::PointProbe& probe : scene.probes->points) {
        const std::size_t b = number(probe.body);
        add_point(probe, scene.bodies[b], bodies[b].mesh, first_node[b]);
    }
    for (const scene::IntegralProbe& integral : scene.probes->integrals) {
        const auto* part = std::get_if<scene::BodyPart>(&integral.over);
        if (!part) continue;
        const std::size_t b = number(part->body);
        add_part(integral.name, *part, bodies[b].mesh, first_node[b],
                 scene.fluid.has_value(), scene.probes->mean_forces);
    }
}

void ProbeRow::add_body(const scene::Scene& scene, std::size_t b,
                        const structure::Body& solid, std::size_t first_node) {
    const structure::Mesh& mesh = solid.mesh;
    for (const auto quantity : scene.probes->bodies) {
        const BodyProbe& probe = body_probe(quantity);
        if (probe.needs == Load::support) {
            add_reactions(b, solid);
            continue;
        }
        if (quantity == scene::BodyQuantity::rigid_motion) {
            for (std::size_t i = 0; i < rigid_parts_.size(); ++i)
                if (rigid_parts_[i].body == b)
                    add_rigid_motion(i, rigid_parts_[i].column, scene.bodies[b].initial);
            continue;
        }
        if (quantity == scene::BodyQuantity::magnetic_load) {
            add_magnetic_load(*scene.magnetic_field, b, solid, first_node);
            continue;
        }
        Group& group = groups_.emplace_back();
        const bool mean =
            scene.probes->mean_forces && quantity == scene::BodyQuantity::fluid_force;
        for (const char* column : probe.columns)
            group.columns.push_back(scene.bodies[b].name + (mean ? ".mean_" : ".") +
                                    column);
        if (mean) {
            group.add = [b](const ProbeSample& sample, Row& row) {
                add(row, sample.loads[b].mean_fluid_force_n);
            };
            continue;
        }
        group.add = [this, b, first_node, count = mesh.nodes.size(),
                     line = mesh.centre_line,
                     values = probe.values](const ProbeSample& sample, Row& row) {
            const Row mine = values({sample.nodes, sample.loads[b], first_node, count,
                                     line, start_m_.data() + first_node});
            row.insert(row.end(), mine.begin(), mine.end());
        };
    }
}

// Centre of mass, turn of the body's frame in space, and both velocities of a rigid part.
// The angles are turns about the axes x, y and z of space, made in this order.
void ProbeRow::add_rigid_motion(std::size_t part, const std::string& column,
                                const scene::Placement& initial) {
    Group& group = groups_.emplace_back();
    for (const char* value :
         {"x[m]", "y[m]", "z[m]", "q_w[1]", "q_x[1]", "q_y[1]", "q_z[1]", "roll[rad]",
          "pitch[rad]", "yaw[rad]", "velocity_x[m/s]", "velocity_y[m/s]",
          "velocity_z[m/s]", "spin_x[rad/s]", "spin_y[rad/s]", "spin_z[rad/s]"})
        group.columns.push_back(column + ".rigid_" + value);
    const Eigen::Quaterniond placed = turn_at_start(initial);
    group.add = [part, placed](const ProbeSample& sample, Row& row) {
        const structure::RigidPartMotion& now = sample.nodes.rigid.at(part);
        const Eigen::Quaterniond turn = now.turn * placed;
        add(row, now.centre_m);
        for (const double q : {turn.w(), turn.x(), turn.y(), turn.z()}) row.push_back(q);
        add(row, angles_rad(turn));
        add(row, now.velocity_m_s);
        add(row, now.angular_velocity_rad_s);
    };
}

// Force of the applied field on a body, gradient and sources included, and its torque
// about the centre of mass.
void ProbeRow::add_magnetic_load(const scene::MagneticField& field, std::size_t b,
                                 const structure::Body& solid, std::size_t first_node) {
    Group& group = groups_.emplace_back();
    for (const char* load : {"magnetic_force_{}[N]", "magnetic_torque_{}[N m]"}) {
        for (const char axis : {'x', 'y', 'z'})
            group.columns.push_back(solid.name + "." +
                                    fmt::format(fmt::runtime(load), axis));
    }
    group.add = [this, b, first_node,
                 forces = std::make_shared<const FieldForces>(solid, field),
                 count = solid.mesh.nodes.size()](const ProbeSample& sample, Row& row) {
        const auto nodes_m =
            std::span(sample.nodes.position_m).subspan(first_node, count);
        const std::vector<Vec3> force_n = forces->at(
            nodes_m, sample.time_s, structure::field_at(field_, sample.time_s));
        const Vec3 centre = mass_weighted_mean({sample.nodes,
                                                sample.loads[b],
                                                first_node,
                                                count,
                                                {},
                                                start_m_.data() + first_node},
                                               sample.nodes.position_m);
        Vec3 force{}, torque{};
        for (std::size_t n = 0; n < count; ++n) {
            force += force_n[n];
            torque += cross(nodes_m[n] - centre, force_n[n]);
        }
        add(row, force);
        add(row, torque);
    };
}

// Three columns for each clamped, moved or rolling face: the force of the support on the
// body. A node that two faces hold counts for the first (structure::held_faces).
void ProbeRow::add_reactions(std::size_t b, const structure::Body& solid) {
    for (const structure::HeldFace& face : structure::held_faces(solid)) {
        Group& group = groups_.emplace_back();
        for (const char axis : {'x', 'y', 'z'})
            group.columns.push_back(
                fmt::format("{}.{}.reaction_{}[N]", solid.name, face.name, axis));
        group.add = [b, nodes = face.nodes](const ProbeSample& sample, Row& row) {
            const std::vector<Vec3>& support_n = sample.loads[b].support_n;
            for (std::size_t d = 0; d < 3; ++d) {
                double sum = 0;
                for (const int node : nodes[d]) sum += support_n[node][d];
                row.push_back(sum);
            }
        };
    }
}

// Present position of a material point and its displacement since step 0.
void ProbeRow::add_point(const scene::PointProbe& probe, const scene::Body& body,
                         const structure::Mesh& mesh, std::size_t first_node) {
    const auto point = locate(body, mesh, probe.at_m);
    const Vec3 start_m = position(point, start_m_, first_node);
    Group& group = groups_.emplace_back();
    for (const char* column : {"x", "y", "z", "ux", "uy", "uz"})
        group.columns.push_back(fmt::format("{}_{}[m]", probe.name, column));
    group.add = [point, start_m, first_node](const ProbeSample& sample, Row& row) {
        const Vec3 now = position(point, sample.nodes.position_m, first_node);
        add(row, now);
        add(row, now - start_m);
    };
}

// Mean displacement weighted with mass, momentum and, in a fluid, the fluid's force on a
// part of a body.
void ProbeRow::add_part(const std::string& name, const scene::BodyPart& part,
                        const structure::Mesh& mesh, std::size_t first_node,
                        bool in_fluid, bool mean_forces) {
    Group& group = groups_.emplace_back();
    for (const char* column :
         {"ux[m]", "uy[m]", "uz[m]", "momentum_x[kg m/s]", "momentum_y[kg m/s]",
          "momentum_z[kg m/s]", "fluid_force_x[N]", "fluid_force_y[N]",
          "fluid_force_z[N]"})
        group.columns.push_back(name + "." + column);
    if (!in_fluid) group.columns.resize(6);
    for (std::size_t i = 6; mean_forces && i < group.columns.size(); ++i)
        group.columns[i].insert(name.size() + 1, "mean_");
    group.add = [this, first_node, in_fluid, number = parts_++,
                 share = node_shares(elements_of(part, mesh), mesh)](
                    const ProbeSample& sample, Row& row) {
        const NodalState& nodes = sample.nodes;
        double mass = 0;
        Vec3 moved{}, momentum{};
        for (std::size_t i = 0; i < share.size(); ++i) {
            const std::size_t n = first_node + i;
            const double m = share[i] * nodes.mass_kg[n];
            mass += m;
            moved += m * (nodes.position_m[n] - start_m_[n]);
            momentum += m * nodes.velocity_m_s[n];
        }
        add(row, moved / mass);
        add(row, momentum);
        if (in_fluid) add(row, sample.force_on_parts_n.at(number));
    };
}

std::vector<std::string> ProbeRow::columns() const {
    std::vector<std::string> all;
    for (const Group& group : groups_)
        all.insert(all.end(), group.columns.begin(), group.columns.end());
    return all;
}

std::vector<double> ProbeRow::values(double time_s, const NodalState& nodes,
                                     const std::vector<BodyLoads>& loads,
                                     const std::vector<Vec3>& force_on_parts_n) const {
    std::vector<double> row;
    const ProbeSample sample{time_s, nodes, loads, force_on_parts_n};
    for (const Group& group : groups_) group.add(sample, row);
    return row;
}

}  // namespace magfsi::bodies
