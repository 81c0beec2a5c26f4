#include "adapters/run_scene.h"

#include <algorithm>
#include <cmath>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"

namespace magfsi {

namespace {

double given_speed(const scene::Fluid& fluid) {
    double largest = 0;
    const auto compare = [&](const scene::Vec3& v) {
        largest = std::max(largest, std::hypot(v[0], v[1], v[2]));
    };
    for (const fluid::Boundary& side : fluid.boundaries) {
        compare(side.wall_velocity_m_s);
        compare(side.inlet.velocity_m_s);
    }
    if (fluid.initial_velocity_m_s) compare(*fluid.initial_velocity_m_s);
    return largest;
}

}  // namespace

coupler::RunPlan run_plan(const scene::Scene& scene) {
    coupler::RunPlan plan;
    plan.name = scene.name;
    plan.scene_hash = scene.hash;
    plan.state_hash = scene::state_hash(scene);
    plan.end_s = scene.time.end_s;
    if (!scene.bodies.empty()) plan.roles.push_back(coupler::Role::structure);
    if (scene.fluid) {
        plan.roles.push_back(coupler::Role::fluid);
        plan.fluid_density_kg_m3 = scene.fluid->density_kg_m3;
        plan.given_speed_m_s = given_speed(*scene.fluid);
    }
    plan.coupling = scene.coupling;
    if (scene.checkpoint)
        plan.checkpoint = {scene.checkpoint->every_s, scene.checkpoint->retry()};
    plan.interface_balance = scene.probes && scene.probes->interface_balance;
    plan.effects = scene::active_effects(scene);
    plan.absent_effects = scene::absent_effects(scene);
    plan.effects_by_step = scene::effects_by_step(scene);
    plan.warnings = scene::idle_effects(scene);
    return plan;
}

int run_scene(coupler::Role role, const std::string& description, int argc, char** argv,
              const RunScene& run) {
    return coupler::run_participant(
        role, description, argc, argv,
        [&](const coupler::ParticipantArguments& arguments, coupler::RunState& state) {
            scene::Scene scene = scene::read_scene(arguments.scene, arguments.overrides);
            scene.time.halvings = arguments.halvings;
            coupler::Session session(role, arguments, run_plan(scene), state);
            run(scene, session, arguments);
        });
}

}  // namespace magfsi
