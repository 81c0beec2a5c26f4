// SPDX-License-Identifier: GPL-2.0-or-later
// The checkpoints in a run folder, and the one that a run continues (--restart latest, or
// --restart FILE).
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

// A checkpoint is a file of each participant of the scene, checkpoint_STEP_structure.h5
// and checkpoint_STEP_fluid.h5. A file gets this name only when it is complete, so a
// checkpoint is complete when all its files are there. The newest complete ones are kept:
constexpr std::size_t checkpoints_kept = 2;

std::filesystem::path checkpoint_file(const std::filesystem::path& folder,
                                      std::int64_t step, Role role);

// The step in the name of a checkpoint's file; none if it is not such a name.
std::optional<std::int64_t> step_in_name(const std::filesystem::path& file);

// The steps of which there is a checkpoint, the newest first: those with at least one
// file, and those that are complete.
std::vector<std::int64_t> steps_found(const std::filesystem::path& folder);
std::vector<std::int64_t> steps_complete(const std::filesystem::path& folder,
                                         const std::vector<Role>& roles);

// Deletes the checkpoints that are older than the ones to keep.
void prune_checkpoints(const std::filesystem::path& folder,
                       const std::vector<Role>& roles);

// Deletes the checkpoints after a step, and files that were not finished when a run was
// killed.
void clear_checkpoints_after(const std::filesystem::path& folder, std::int64_t step);

// The checkpoint that a run continues.
struct RestartPoint {
    std::filesystem::path folder;  // of the checkpoint's files
    StateHeader header;
    // Why newer checkpoints could not be used; one line each, of "latest" only.
    std::vector<std::string> skipped;
};

// wanted: "latest", the newest usable checkpoint of the run folder, or the path of one of
// a checkpoint's files. All files of the checkpoint are read once, so that damage is
// found now. Throws std::invalid_argument with one line where there is no checkpoint,
// where it belongs to another scene (which may differ in time.end), and where the one
// that was named is damaged or incomplete; "latest" then takes the one before.
RestartPoint find_restart(const std::string& wanted,
                          const std::filesystem::path& run_folder, const RunPlan& plan);

// The folder of the checkpoint that `wanted` means.
std::filesystem::path restart_folder(const std::string& wanted,
                                     const std::filesystem::path& run_folder);

}  // namespace magfsi::coupler
