// What a participant runs, in the coupler's own terms. adapters/run_scene.cpp fills it.
#pragma once

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
    std::vector<Role> roles;           // the participants of the run
    std::optional<Coupling> coupling;  // present where there are both
    std::optional<CheckpointPlan> checkpoint;
    bool interface_balance = false;  // is audited

    // Of the fluid, where there is one.
    double fluid_density_kg_m3 = 0;
    double given_speed_m_s = 0;  // the largest of inlets, walls and the initial flow

    // For log and summary.
    std::vector<std::string> effects, absent_effects;
    std::vector<std::string> effects_by_step;  // a line for each part of the step
    std::vector<std::string> warnings;
};

}  // namespace magfsi::coupler
