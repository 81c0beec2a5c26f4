// SPDX-License-Identifier: GPL-2.0-or-later
// The plan of a run in the coupler's own terms; adapters/run_scene.cpp makes it from a
// scene.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/vector/vec3.h"
#include "coupler/options.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

// Checkpoints of a run.
struct CheckpointPlan {
    double every_s = 0;
    // After a divergence: restart from the last checkpoint with half the step size.
    bool retry = false;
};

// The scene as its run folder keeps it.
struct KeptInput {
    // Text that runs again from there; the text as given if that differs, else ""; the
    // values as read, in SI units (JSON).
    std::string scene, as_given, as_read;
    // Files that the scene reads, and their names in the run folder.
    std::vector<std::pair<std::filesystem::path, std::string>> files;
};

// Everything about a run that the coupler needs to know; times in [s].
struct RunPlan {
    std::string name;
    std::uint64_t scene_hash = 0;
    // Hash of the scene without end_s, which a restart may change; 0 in runs that neither
    // write nor read checkpoints.
    std::uint64_t state_hash = 0;
    double end_s = 0;
    // Coupled steps in one step of a refined grid's coarsest level.
    int steps_at_a_time = 1;
    std::vector<Role> roles;           // participants of the run
    bool controlled = false;           // the structure has a controller
    std::optional<Coupling> coupling;  // present if structure and fluid are coupled
    std::optional<CheckpointPlan> checkpoint;
    bool interface_balance = false;  // the interface is audited

    // Properties of the fluid; 0 without one.
    double fluid_density_kg_m3 = 0;
    bool fluid_is_incompressible = false;  // pressure answers a force within the step
    Vec3 fluid_body_force_n_m3{};
    double given_speed_m_s = 0;  // largest speed of inlets, walls and initial flow

    // Names of what the solvers leave in the run folder, beside the coupler's own files.
    std::vector<std::string> solver_folders;

    // Makes what the run folder keeps of the scene. The leading process alone calls it.
    std::function<KeptInput()> input;
    std::string machine;  // description of the machine
    // Texts for log and summary.
    std::vector<std::string> effects, absent_effects;
    std::vector<std::string> effects_by_step;  // one line for each part of the step
    std::vector<std::string> warnings;
};

}  // namespace magfsi::coupler
