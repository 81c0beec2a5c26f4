// SPDX-License-Identifier: GPL-2.0-or-later
// The bridge from the scene, which the coupler does not know, to the coupler's own
// options (RunPlan).
#include "adapters/run_scene.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "adapters/scene/effective.h"
#include "adapters/scene/kept_scene.h"
#include "adapters/scene/reader.h"
#include "base/fitted/constants.h"
#include "coupler/checkpoint/restart.h"

namespace magfsi {

namespace {

// Largest speed [m/s] that the scene prescribes to the fluid: walls, inlets, initial
// velocity.
double given_speed(const scene::Fluid& fluid) {
    double largest = 0;
    const auto compare = [&](const scene::Vec3& v) {
        largest = std::max(largest, norm(v));
    };
    for (const fluid::Boundary& side : fluid.boundaries) {
        compare(side.wall_velocity_m_s);
        compare(side.inlet.velocity_m_s);
    }
    if (fluid.initial_velocity_m_s) compare(*fluid.initial_velocity_m_s);
    return largest;
}

coupler::KeptInput kept_input(const coupler::ParticipantArguments& arguments,
                              const scene::Scene& scene) {
    scene::KeptScene kept =
        scene::kept_scene(arguments.scene, arguments.overrides, scene);
    coupler::KeptInput input{std::move(kept.complete), {}, {}, {}};
    if (kept.as_given != input.scene) input.as_given = std::move(kept.as_given);
    input.as_read = scene::effective_scene(scene).dump(2) + "\n";
    for (auto& [file, name] : kept.files) input.files.emplace_back(file, name);
    return input;
}

}  // namespace

int available_cores() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
    return CPU_COUNT(&set);
}

// Counts the cells of the coarsest level.
int worthwhile_parts(const scene::Fluid& fluid) {
    double cells = 1;
    for (const double length : fluid.box_m) cells *= length / fluid.spacing_m;
    return std::clamp(cells / fitted::cells_worth_a_rank, 1.0, 1e6);
}

// "a processor" where /proc/cpuinfo names none, as on some ARM machines.
std::string processor() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);) {
        const auto colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos)
            return line.substr(colon + 2);
    }
    return "a processor";
}

// Warnings become part of the log: effects without influence and rounded intervals.
coupler::RunPlan run_plan(const scene::Scene& scene, bool goes_on) {
    coupler::RunPlan plan;
    plan.name = scene.name;
    plan.scene_hash = scene.hash;
    if (scene.checkpoint || goes_on) plan.state_hash = scene::state_hash(scene);
    plan.end_s = scene.time.end_s;
    const auto& solvers = scene::names<scene::FluidSolver>;
    plan.solver_folders.assign(solvers.begin(), solvers.end());
    if (scene.has_structure()) plan.roles.push_back(coupler::Role::structure);
    plan.controlled = scene.control.has_value();
    if (scene.fluid) {
        plan.roles.push_back(coupler::Role::fluid);
        plan.steps_at_a_time = scene.fluid->coupled_steps_in_one();
        plan.fluid_density_kg_m3 = scene.fluid->density_kg_m3;
        plan.fluid_is_incompressible = scene.fluid->solver != scene::FluidSolver::lbm;
        plan.fluid_body_force_n_m3 = scene.fluid->body_force_n_m3.value_or(scene::Vec3{});
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
    for (std::string& line : scene::rounded_intervals(scene))
        plan.warnings.push_back(std::move(line));
    return plan;
}

bool goes_on_in(const std::filesystem::path& out, const std::string& restart) {
    if (restart.empty()) return false;
    std::error_code none;  // false where one of them is not there
    return std::filesystem::equivalent(coupler::restart_folder(restart, out), out, none);
}

void refuse_own_scene(const std::filesystem::path& scene_file,
                      const std::filesystem::path& out, const std::string& restart) {
    std::error_code none;
    if (!std::filesystem::equivalent(scene_file, out / "scene.yaml", none) ||
        goes_on_in(out, restart))
        return;
    throw std::invalid_argument(
        fmt::format("--out: found {}, the folder of the scene itself, which would be "
                    "moved aside with the results there; allowed are other folders",
                    out.string()));
}

void require_solver(const scene::Scene& scene, scene::FluidSolver solver) {
    if (!scene.fluid)
        throw std::invalid_argument(
            "the scene has no fluid; use ./magfsi run SCENE, which starts what it has");
    if (scene.fluid->solver == solver) return;
    throw std::invalid_argument(fmt::format(
        "the scene's fluid.solver is {}; start magfsi-fluid-{} for it, or use "
        "./magfsi run SCENE --fluid {}",
        scene::name_of(scene.fluid->solver), scene::name_of(scene.fluid->solver),
        scene::name_of(solver)));
}

int run_scene(coupler::Role role, const std::string& description, int argc, char** argv,
              const RunScene& run) {
    return coupler::run_participant(
        role, description, argc, argv,
        [&](const coupler::ParticipantArguments& arguments, coupler::RunState& state) {
            scene::Scene scene = scene::read_scene(arguments.scene, arguments.overrides);
            scene.time.halvings = arguments.halvings;
            refuse_own_scene(
                scene::scene_file(arguments.scene),
                arguments.out.empty() ? coupler::default_out(scene.name) : arguments.out,
                arguments.restart);
            coupler::RunPlan plan = run_plan(scene, !arguments.restart.empty());
            plan.input = [&] { return kept_input(arguments, scene); };
            // All cores of the machine count: mpirun may bind this process to one of
            // them.
            plan.machine = fmt::format("{}, {} cores", processor(),
                                       std::thread::hardware_concurrency());
            coupler::Session session(role, arguments, std::move(plan), state);
            run(scene, session, arguments);
        });
}

}  // namespace magfsi
