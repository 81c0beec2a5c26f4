// SPDX-License-Identifier: GPL-2.0-or-later
// The checkpoints in a run folder, and the choice of the one that a run continues
// (--restart latest, or --restart FILE).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/checkpoint/state_file.h"
#include "coupler/participants/run_plan.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

// A checkpoint consists of one file per participant of the scene,
// checkpoint_STEP_structure.h5 and checkpoint_STEP_fluid.h5. A file gets this name only
// when it is complete, so that a checkpoint is complete when all its files exist. Number
// of complete checkpoints that are kept, the newest ones:
constexpr std::size_t checkpoints_kept = 2;

// Path of a participant's file of the checkpoint of a step.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder,
                                      std::int64_t step, Role role);

// The step in a checkpoint file's name; empty if the name is not of that form. Names of
// unfinished files count, too.
std::optional<std::int64_t> step_in_name(const std::filesystem::path& file);

// Steps with a checkpoint in the folder, the newest first: those with at least one
// finished file, and those that have a file of each role.
std::vector<std::int64_t> steps_found(const std::filesystem::path& folder);
std::vector<std::int64_t> steps_complete(const std::filesystem::path& folder,
                                         const std::vector<Role>& roles);

// Deletes the files of checkpoints older than the oldest one to keep. Incomplete
// checkpoints that are newer stay.
void prune_checkpoints(const std::filesystem::path& folder,
                       const std::vector<Role>& roles);

// Deletes the checkpoints of later steps, and files that were unfinished when a run was
// killed.
void clear_checkpoints_after(const std::filesystem::path& folder, std::int64_t step);

// The checkpoint that a run continues, and why newer ones were passed over.
struct RestartPoint {
    std::filesystem::path folder;  // the folder of the checkpoint's files
    StateHeader header;
    // One line for each newer checkpoint that "latest" could not use, with the reason.
    std::vector<std::string> skipped;
};

// Finds the checkpoint that `wanted` means: "latest", the newest usable one of the run
// folder, or the path of any file of a checkpoint. Reads all its files once, so that
// damage is found before the run starts; "latest" passes over a damaged or incomplete
// checkpoint. Throws std::invalid_argument with a message of one line if there is no
// checkpoint, if it belongs to another scene (only time.end may differ) or lies beyond
// the end of the run, and if a named one is damaged or incomplete.
RestartPoint find_restart(const std::string& wanted,
                          const std::filesystem::path& run_folder, const RunPlan& plan);

// The folder of the checkpoint that `wanted` means; it need not exist.
std::filesystem::path restart_folder(const std::string& wanted,
                                     const std::filesystem::path& run_folder);

}  // namespace magfsi::coupler
