// SPDX-License-Identifier: GPL-2.0-or-later
// What a participant runs, in the coupler's own terms. adapters/run_scene.cpp fills it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coupler/options.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

struct CheckpointPlan {
    double every_s = 0;
    bool retry =
        false;  // after a divergence, from the last checkpoint with half the steps
};

struct RunPlan {
    std::string name;
    std::uint64_t scene_hash = 0;
    std::uint64_t state_hash =
        0;  // the same whatever end_s: a run may go on to a later end
    double end_s = 0;
    int steps_at_a_time = 1;           // whole steps of a refined grid's coarsest level
    std::vector<Role> roles;           // the participants of the run
    bool controlled = false;           // the structure has a controller
    std::optional<Coupling> coupling;  // present where there are both
    std::optional<CheckpointPlan> checkpoint;
    bool interface_balance = false;  // is audited

    // Of the fluid, where there is one.
    double fluid_density_kg_m3 = 0;
    std::array<double, 3> fluid_body_force_n_m3{};
    double given_speed_m_s = 0;  // the largest of inlets, walls and the initial flow

    // What a fluid leaves in the run folder beside the coupler's own files.
    std::vector<std::string> solver_folders;

    // For the run folder: the scene's text as given, and as read, in SI units (JSON).
    std::string scene_as_given, scene_as_read;
    std::string machine;  // in words
    // For log and summary.
    std::vector<std::string> effects, absent_effects;
    std::vector<std::string> effects_by_step;  // a line for each part of the step
    std::vector<std::string> warnings;
};

}  // namespace magfsi::coupler
