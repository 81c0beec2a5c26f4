// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/scene_to_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "adapters/solvers/bodies/fluid_inside.h"
#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/bodies/probe_row.h"
#include "structure/lattice/stable_step.h"

namespace magfsi::lammps {

namespace {

// The surfaces that bodies can touch. With contact an obstacle of another shape is an
// error.
structure::SolidShape surface_of(const scene::Sphere& ball) {
    return structure::Ball{ball.centre_m, 0.5 * ball.diameter_m};
}
structure::SolidShape surface_of(const scene::Block& block) {
    return structure::Brick{block.low_m, block.high_m};
}
structure::SolidShape surface_of(const scene::Cylinder& rod) {
    std::optional<double> half_m;
    if (rod.length_m) half_m = 0.5 * *rod.length_m;
    return structure::Rod{rod.centre_m, 0.5 * rod.diameter_m, rod.axis, half_m};
}
structure::SolidShape surface_of(const scene::StlSurface& stl) {
    return structure::read_surface(stl.file, stl.unit_m, stl.shift_m);
}

structure::SolidShape surface_of(const scene::Obstacle& obstacle) {
    return std::visit(
        [&](const auto& shape) -> structure::SolidShape {
            if constexpr (requires { surface_of(shape); })
                return surface_of(shape);
            else
                throw std::invalid_argument(
                    fmt::format("contact: bodies cannot touch obstacles of the shape of "
                                "'{}'; leave out contact, or take a sphere, a cylinder, "
                                "a box or an STL surface",
                                obstacle.name));
        },
        obstacle.shape);
}

// True if a node starts deeper than deep_m in the shape; the shape then holds the body.
bool starts_in(const structure::SolidShape& shape, const structure::Vec3& period_m,
               const std::vector<structure::Vec3>& nodes_m, double deep_m) {
    return std::ranges::any_of(nodes_m, [&](const structure::Vec3& x) {
        return structure::signed_distance(shape, x, period_m).distance_m < -deep_m;
    });
}

// Adds the obstacles of the fluid as walls for the bodies that do not start in them.
void add_obstacles(std::vector<structure::Wall>& walls, const scene::Scene& scene,
                   const std::vector<structure::Body>& bodies) {
    std::vector<std::vector<structure::Vec3>> start_m;
    for (std::size_t b = 0; b < bodies.size() && !scene.fluid->obstacles.empty(); ++b) {
        scene::Placement placement = scene.bodies[b].initial;
        placement.relaxed.reset();
        start_m.push_back(structure::placed_nodes(bodies[b], placement, {0, 2}));
    }
    for (std::size_t o = 0; o < scene.fluid->obstacles.size(); ++o) {
        structure::Wall wall{fmt::format("obstacle_{}", o + 1), {}, {}, {}};
        wall.shape = surface_of(scene.fluid->obstacles[o]);
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            // The same depth as in outputs/overlap.cpp.
            const double deep_m = 0.05 * scene.fluid->finest_spacing_m();
            if (!starts_in(*wall.shape, scene.fluid->period_m(), start_m[b], deep_m))
                wall.bodies.push_back(b);
        }
        if (!wall.bodies.empty()) walls.push_back(std::move(wall));
    }
}

// Walls that keep bodies in a fluid, with contact: the sides of its box that are not
// periodic, for bodies that do not span the box to them, and its obstacles.
std::vector<structure::Wall> walls_of(const scene::Scene& scene,
                                      const std::vector<structure::Body>& bodies) {
    std::vector<structure::Wall> walls;
    if (!scene.contact || !scene.fluid) return walls;
    for (std::size_t side = 0; side < scene.fluid->boundaries.size(); ++side) {
        if (scene.fluid->boundaries[side].kind == scene::BoundaryKind::periodic) continue;
        const std::size_t axis = side / 2;
        structure::Wall wall{std::string(scene::names<scene::Face>[side]), {}, {}, {}};
        wall.plane.normal = {};
        wall.plane.normal[axis] = side % 2 == 0 ? 1 : -1;
        if (side % 2 == 1) wall.plane.point_m[axis] = scene.fluid->box_m[axis];
        for (std::size_t b = 0; b < scene.bodies.size(); ++b)
            if (!bodies::spans_fluid(*scene.fluid, scene.bodies[b], bodies[b].mesh,
                                     true)[axis])
                wall.bodies.push_back(b);
        if (!wall.bodies.empty()) walls.push_back(std::move(wall));
    }
    add_obstacles(walls, scene, bodies);
    return walls;
}

}  // namespace

// The law of the uniform field is left out where the scene has only a gradient or
// sources: its course means nothing there.
structure::LammpsInput to_lammps_input(const scene::Scene& scene,
                                       const bodies::Solids& solids) {
    structure::LammpsInput input;
    input.bodies = bodies::bodies_in_fluid(scene, solids);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        input.placements.push_back(scene.bodies[b].initial);
        for (structure::PrescribedMotion motion : scene.bodies[b].prescribed_motion) {
            motion.body = b;
            input.motions.push_back(motion);
        }
    }
    if (scene.magnetic_field) {
        if (scene.magnetic_field->uniform) input.field = scene.magnetic_field;
        input.gradient = scene.magnetic_field->gradient;
        input.sources = scene.magnetic_field->sources;
    }
    input.dipoles = scene.dipoles;
    input.gravity_m_s2 = bodies::to_gravity(scene);
    input.drag = scene.damping;
    input.platform = scene.platform;
    input.contact = scene.contact;
    if (scene.fluid) input.period_m = scene.fluid->period_m();
    input.walls = walls_of(scene, input.bodies);
    input.reactions = bodies::needs(scene, bodies::Load::support);
    input.contact_load = bodies::needs(scene, bodies::Load::contact);
    structure::check_effects(input);
    return input;
}

double stable_step_s(const structure::LammpsInput& input) {
    double smallest = 0;
    for (const structure::Body& body : input.bodies) {
        // Springs of platform and contact on its surface count with its own stiffness and
        // viscosity, since all may act at once.
        const double step =
            structure::step_limit_s(body, structure::surface_spring_pa_m(input, body));
        smallest = smallest > 0 ? std::min(smallest, step) : step;
    }
    return smallest;
}

}  // namespace magfsi::lammps
