// SPDX-License-Identifier: GPL-2.0-or-later
// Text on each body, from the mesh of the run. Estimates beyond a threshold
// come with a warning and advice.
#include "adapters/app/explain_bodies.h"
#include "adapters/app/explain_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adapters/app/participants.h"
#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/fluid_inside.h"
#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/bodies/mesh_estimate.h"
#include "adapters/solvers/bodies/probe_row.h"
#include "adapters/solvers/bodies/surroundings.h"
#include "adapters/solvers/lammps/substeps.h"
#include "base/words/likely_unit.h"
#include "structure/equilibrium/static_problem.h"
#include "structure/lammps/field_program.h"
#include "structure/lammps/placement.h"
#include "structure/lattice/hexahedron.h"
#include "structure/lattice/lattice.h"
#include "structure/magnetics/source_field.h"

namespace magfsi::launch {
namespace {

// Note on a thin sheet with a no-slip surface: a single layer of markers moves more or
// less fluid along with it than the sheet's volume.
std::string explain_layer(const scene::Scene& scene, std::size_t number,
                          const structure::Mesh& mesh) {
    const auto layer = bodies::carried_layer(scene, number, mesh);
    if (!layer) return "";
    const double spacing_m = scene.fluid->finest_spacing_m();
    std::string text = fmt::format(
        "    one layer of markers carries {:.2f} spacings of fluid, the sheet is {:.2f} "
        "thick: the inertia of the difference along the surface is taken away",
        layer->carried_m / spacing_m, layer->thickness_m / spacing_m);
    if (layer->carried_m > layer->thickness_m)
        text += fmt::format(
            "; large strokes have too little drag on such a grid: for a net motion "
            "take a spacing of at most {:.3g} mm",
            1e3 * spacing_m * layer->thickness_m / layer->carried_m);
    return text + "\n";
}

// Treatment of the inertia of the fluid that the grid has inside the body: subtracted
// from the nodes' mass, by a force on the markers, or in part by each.
std::string explain_inertia(const scene::Scene& scene, const structure::Body& solid) {
    const double off = bodies::off_nodes_kg_m3(scene, solid);
    const double fluid = scene.fluid->density_kg_m3;
    if (off == fluid)
        return "    inertia of the enclosed fluid: subtracted from the nodes' mass\n";
    if (off == 0)
        return fmt::format(
            "    inertia of the enclosed fluid: a force on the markers{}\n",
            bodies::has_drag(scene) ? ", as damping slows down nodes by their own mass"
                                    : "");
    return fmt::format(
        "    inertia of the enclosed fluid: {:.3g} % subtracted from the nodes' mass, "
        "the rest a force on the markers\n",
        100 * off / fluid);
}

// Throws std::invalid_argument for a mesh that the run would refuse: contradicting
// supports, inverted elements, an equilibrium of a body that is free to move. On a
// platform even parts without support come to rest.
void refuse_what_cannot_run(const scene::Scene& scene, const structure::Body& solid) {
    (void)structure::held_axes(solid);
    (void)structure::build_lattice(solid);
    if (scene.time.equilibrium && !scene.platform) structure::require_held(solid, {});
}

// Checks what depends on the mesh: number of elements and markers, places of probes.
// Refuses a body of a mesh file that is far larger than the box of the fluid or than any
// robot: the file is in another unit.
void check_size(const scene::Scene& scene, const scene::Body& body,
                const structure::Vec3& size_m) {
    const auto* mesh = std::get_if<structure::MeshFile>(&body.mesh);
    if (mesh == nullptr) return;
    constexpr double larger = 20, least_m = 1e-5, largest_robot_m = 10;
    const double room_m =
        scene.fluid ? std::ranges::max(scene.fluid->box_m) : largest_robot_m / larger;
    const double most_m = std::ranges::max(size_m);
    scene::require(most_m <= larger * room_m, {fmt::format("body '{}'", body.name)},
                   fmt::format("the mesh {}, which spans {:.3g} x {:.3g} x {:.3g} m",
                               mesh->file, size_m[0], size_m[1], size_m[2]),
                   fmt::format("at most {:.3g} m here", larger * room_m),
                   words::likely_unit(most_m, mesh->unit_m, least_m, 2 * room_m));
}

// Throws std::invalid_argument as the run would.
void check_on_mesh(const scene::Scene& scene, const scene::Body& body,
                   const structure::Body& solid) {
    const structure::Vec3 size_m = structure::bounds(solid.mesh.nodes).extent_m();
    check_size(scene, body, size_m);
    const double elements = solid.mesh.elements.size();
    scene::require(elements <= scene::max_elements, {fmt::format("body '{}'", body.name)},
                   fmt::format("a mesh of {} elements", elements),
                   fmt::format("at most {:.0f}", scene::max_elements));
    const double markers = scene::most_markers(scene, size_m);
    scene::require(markers <= scene::max_markers, {fmt::format("body '{}'", body.name)},
                   fmt::format("up to {:.3g} markers", markers),
                   fmt::format("at most {:.0f}", scene::max_markers),
                   "take a larger fluid.spacing");
    if (!scene.probes) return;
    constexpr std::size_t points_of_a_shape = 4;
    scene::require(std::ranges::find(scene.probes->bodies, scene::BodyQuantity::shape) ==
                           scene.probes->bodies.end() ||
                       solid.mesh.centre_line.size() >= points_of_a_shape,
                   {"probes.bodies"},
                   fmt::format("shape of body '{}', whose centre line has {} points",
                               body.name, solid.mesh.centre_line.size()),
                   fmt::format("it of blocks, arcs and helices of {} elements or more "
                               "along their first axis, and of Gmsh meshes with a curve "
                               "named centre_line",
                               points_of_a_shape - 1),
                   "leave shape out, and name places in probes.points");
    for (const scene::PointProbe& point : scene.probes->points) {
        if (point.body == body.name) (void)bodies::locate(body, solid.mesh, point.at_m);
    }
    for (const scene::IntegralProbe& integral : scene.probes->integrals) {
        const auto* part = std::get_if<scene::BodyPart>(&integral.over);
        if (part && part->body == body.name) (void)bodies::elements_of(*part, solid.mesh);
    }
}

// Largest magnitude of the field [T] at the body. A uniform field is exact. Fields of
// sources are sampled at up to about 50 elements and 101 instants, with the body at its
// initial place and not bent (a body with initial.relaxed is taken as straight).
double strongest_field_t(const scene::Scene& scene, const scene::Body& body,
                         const structure::Body& solid) {
    const scene::MagneticField& field = *scene.magnetic_field;
    if (field.sources.empty()) {
        return norm(bodies::strongest_field_t(scene));
    }
    constexpr std::size_t most_places = 50;
    constexpr int instants = 100;
    structure::Placement placement = body.initial;
    placement.relaxed.reset();
    const auto nodes_m = structure::placed_nodes(solid, placement, {0, 2});
    structure::SourceField sources(field.sources);
    double strongest = 0;
    for (int i = 0; i <= instants; ++i) {
        const double t = scene.time.end_s * i / instants;
        sources.set_time(t);
        const structure::Vec3 even = structure::field_at(field, t);
        const std::size_t elements = solid.mesh.elements.size();
        for (std::size_t e = 0; e < elements; e += 1 + elements / most_places) {
            const auto corners = structure::gather(nodes_m, solid.mesh.elements[e]);
            const Eigen::Vector3d middle = corners.colwise().mean();
            try {
                const auto there = sources.sample({middle[0], middle[1], middle[2]});
                strongest = std::max(
                    strongest,
                    (there.field_t + Eigen::Vector3d(even[0], even[1], even[2])).norm());
            } catch (
                const std::runtime_error& left) {  // a fault of the scene before a run
                throw std::invalid_argument(
                    fmt::format("body '{}': {}", body.name, left.what()));
            }
        }
    }
    return strongest;
}

// Size, mass, supports and loads of a body. M B / G estimates the strain caused by the
// field.
std::string explain_loads(const scene::Scene& scene, const scene::Body& body,
                          const structure::Body& solid) {
    const structure::Vec3 size = structure::bounds(solid.mesh.nodes).extent_m();
    double mass = 0;
    for (const double m : structure::build_lattice(solid).node_mass_kg) mass += m;
    std::string text =
        fmt::format("    size {:.4g} x {:.4g} x {:.4g} mm, mass {:.4g} mg\n",
                    1e3 * size[0], 1e3 * size[1], 1e3 * size[2], 1e6 * mass);
    std::vector<std::string> held;
    const auto with_nodes = [&](const std::string& face) {
        return fmt::format("{} ({} nodes)", face,
                           structure::face_nodes(solid, face, "held").size());
    };
    for (const std::string& face : body.clamps)
        held.push_back(with_nodes(face) + " clamped");
    for (const structure::Roller& roller : body.rollers) {
        for (const std::string& face : roller.faces)
            held.push_back(fmt::format("{} along {}", with_nodes(face),
                                       scene::axis_names[roller.axis]));
    }
    for (const structure::PrescribedMotion& motion : body.prescribed_motion) {
        const bool turned =
            std::holds_alternative<structure::TurningMotion>(motion.course);
        for (const std::string& face : motion.faces)
            held.push_back(with_nodes(face) + (turned ? " turned" : " moved"));
    }
    text +=
        fmt::format("    held: {}\n",
                    held.empty() ? "nowhere" : fmt::format("{}", fmt::join(held, "; ")));
    if (scene.gravity)
        text += fmt::format("    weight {:.4g} uN{}\n",
                            1e6 * mass * scene.gravity->acceleration_m_s2,
                            scene.fluid ? ", buoyancy apart" : "");
    if (!scene.magnetic_field || solid.magnetization_a_m.empty()) return text;
    double largest = 0;
    for (std::size_t e = 0; e < solid.magnetization_a_m.size(); ++e) {
        if (!structure::is_soft(solid, e)) continue;
        largest =
            std::max(largest, norm(solid.magnetization_a_m[e]) /
                                  structure::material_of(solid, e).shear_modulus_pa);
    }
    const double field_t = strongest_field_t(scene, body, solid);
    return text +
           fmt::format("    field up to {:.4g} mT{}: largest M B / G {:.3g}\n",
                       1e3 * field_t,
                       scene.magnetic_field->sources.empty() ? "" : " where it starts",
                       largest * field_t);
}

// All lines on one body. Faults of its mesh are thrown before anything is computed on it.
std::string explain_body(const scene::Scene& scene, std::size_t number,
                         const structure::Body& solid) {
    const scene::Body& body = scene.bodies[number];
    check_on_mesh(scene, body, solid);
    refuse_what_cannot_run(scene, solid);
    std::string text = fmt::format("  body '{}': ", body.name);
    const auto* box = std::get_if<structure::Box>(&body.mesh);
    if (box) {
        const auto& n = box->elements;
        text += fmt::format("{} x {} x {} = ", n[0], n[1], n[2]);
    }
    text += fmt::format("{} elements {}, {} nodes\n", solid.mesh.elements.size(),
                        scene::name_of(body.element), solid.mesh.nodes.size());
    const auto* voxels = std::get_if<structure::VoxelMesh>(&body.mesh);
    if (!solid.mesh.region_names.empty()) text += explain_regions(solid.mesh);
    for (const auto& entry : body.material_regions) {
        text +=
            fmt::format("    {}: G {:.4g} Pa, lambda {:.4g} Pa, density {:.4g} kg/m3\n",
                        fmt::join(entry.regions, ", "), entry.material.shear_modulus_pa,
                        entry.material.lame_lambda_pa, entry.material.density_kg_m3);
    }
    text += explain_loads(scene, body, solid);
    text += explain_error(scene, body, solid);
    const bool some_soft = !structure::is_all_rigid(solid);
    if (box && some_soft) text += explain_bricks(solid, *box);
    if (voxels) text += explain_voxels(solid, *voxels);
    if (!scene.time.equilibrium && some_soft) text += explain_moments(scene, solid);
    text += explain_rigid_parts(solid);
    if (scene.coupling) {
        text += explain_inertia(scene, solid);
        text += fmt::format("    {} markers, forcing {}\n",
                            bodies::place_markers(scene, number, solid.mesh).size(),
                            name_of(*scene.coupling->immersed_boundary.forcing));
        text += explain_layer(scene, number, solid.mesh);
    }
    return text;
}

// Coupled step, substeps, and the two limits of the substep: elastic waves and the
// explicit drag.
std::string explain_steps(const scene::Scene& scene, const bodies::Solids& solids) {
    const lammps::Substeps s = lammps::choose_substeps(scene, solids);
    std::string text =
        fmt::format("  coupled step {:.4g} us = {} LAMMPS steps of {:.4g} us\n",
                    s.coupled_step_s * 1e6, s.count, s.lammps_step_s * 1e6);
    if (std::isinf(s.elastic_limit_s)) {
        const bool rigid = scene::has_effect(scene, "rigid parts");
        return text + (rigid ? "    nothing soft can move: the lattice sets no limit\n"
                             : "    every node is clamped: one step is enough\n");
    }
    text += fmt::format("    stable step of the lattice        {:.4g} us\n",
                        s.elastic_limit_s * 1e6);
    if (s.drag_limit_s > 0 && std::isfinite(s.drag_limit_s)) {
        text += fmt::format("    stable step of the fluid's force  {:.4g} us\n",
                            s.drag_limit_s * 1e6);
    }
    return text;
}

}  // namespace

// The field sources and, for Newton's method, the surroundings are built only for the
// faults that show then.
std::string explain_structure(const scene::Scene& scene, const bodies::Solids& solids) {
    const bool newton = by_newton(scene);
    std::string text = newton ? "\nstructure (Newton's method)\n"
                              : "\nstructure (LAMMPS, fix magttice)\n";
    for (std::size_t b = 0; b < solids.size(); ++b)
        text += explain_body(scene, b, solids[b]);
    if (scene.magnetic_field)  // reads and refuses as the run would
        (void)structure::SourceField(scene.magnetic_field->sources);
    if (newton) (void)bodies::to_surroundings(scene, solids);  // refuses as the run would
    if (!scene.time.equilibrium) return text + explain_steps(scene, solids);
    const double points = scene.time.end_s / scene::path_step_s(scene);
    text += fmt::format("  {:.0f} equilibria along the path of loads\n", points);
    if (!newton) {
        text += fmt::format("  LAMMPS steps of {:.4g} us until at rest\n",
                            lammps::choose_substeps(scene, solids).lammps_step_s * 1e6);
    }
    return text;
}

}  // namespace magfsi::launch
