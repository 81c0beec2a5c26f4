// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/surroundings.h"

#include "adapters/solvers/bodies/field_work.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/equilibrium/newton.h"
#include "structure/lammps/field_program.h"
#include "structure/lammps/placement.h"
#include "structure/lammps/platform_law.h"
#include "structure/motion.h"

namespace magfsi::bodies {

std::vector<structure::Surroundings> to_surroundings(
    const scene::Scene& scene, const std::vector<structure::Body>& solids) {
    std::vector<structure::Surroundings> all(solids.size());
    std::vector<structure::PrescribedMotion> motions;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        for (structure::PrescribedMotion motion : scene.bodies[b].prescribed_motion) {
            all[b].driven.push_back(structure::moved_nodes(solids[b], motion));
            motion.body = b;
            motions.push_back(motion);
        }
        const bool magnetic =
            scene.magnetic_field && !solids[b].magnetization_a_m.empty();
        if (magnetic && scene.magnetic_field->gradient)
            all[b].gradient.emplace(*scene.magnetic_field->gradient);
        if (magnetic && !scene.magnetic_field->sources.empty())
            all[b].sources =
                std::make_shared<structure::SourceField>(scene.magnetic_field->sources);
        if (scene.platform)
            all[b].platform = structure::with_stiffness(*scene.platform, solids);
    }
    structure::check_motions(solids, motions);
    const structure::Vec3 gravity = to_gravity(scene).value_or(structure::Vec3{});
    for (std::size_t b = 0; b < solids.size(); ++b)
        structure::require_held(solids[b], gravity, all[b]);
    return all;
}

// Gradient and sources act at full strength or not at all; a body without magnetisation
// feels no field.
structure::StaticLoads loads_at(const scene::Scene& scene, const scene::Body& body,
                                double time_s) {
    structure::StaticLoads loads;
    if (scene.magnetic_field && body.magnetization) {
        loads.field_t = structure::field_at(*scene.magnetic_field, time_s);
        loads.gradient = scene.magnetic_field->gradient ? 1 : 0;
        loads.sources = scene.magnetic_field->sources.empty() ? 0 : 1;
        loads.sources_s = time_s;
    }
    loads.gravity_m_s2 = to_gravity(scene).value_or(structure::Vec3{});
    for (const structure::PrescribedMotion& motion : body.prescribed_motion)
        loads.driven_m.push_back(structure::start_displacement_m(motion.course) +
                                 structure::displacement_m(motion.course, time_s));
    return loads;
}

std::vector<std::vector<structure::Vec3>> equilibria_at_start(
    const scene::Scene& scene, const std::vector<structure::Body>& solids) {
    std::vector<std::vector<structure::Vec3>> out;
    const auto surroundings = to_surroundings(scene, solids);
    const std::array<int, 2> plane =
        scene.magnetic_field ? scene.magnetic_field->plane : std::array<int, 2>{0, 2};
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const scene::Body& described = scene.bodies[b];
        structure::EquilibriumOptions options;
        options.leave_unstable = true;
        structure::NewtonSolver solver(solids[b], options, surroundings[b]);
        const auto placed = structure::placed_nodes(solids[b], described.initial, plane);
        const structure::StaticLoads loads = loads_at(scene, described, 0);
        // A clamped body takes its loads in increments; a free one is released.
        out.push_back(is_let_go(solids[b], described.initial)
                          ? solver.release(placed, loads).nodes_m
                          : solver.follow(placed, {}, {&loads, 1}).front().nodes_m);
    }
    return out;
}

}  // namespace magfsi::bodies
