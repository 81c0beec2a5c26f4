// The checkpoints of a run folder, and where a run goes on: --restart latest, or FILE.
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

// checkpoint_STEP_structure.h5 and
// checkpoint_STEP_fluid.h5, of each participant that the scene has. One is complete when
// all its files have their names.
constexpr std::size_t checkpoints_kept = 2;

std::filesystem::path checkpoint_file(const std::filesystem::path& folder,
                                      std::int64_t step, Role role);

// The step in the name of a checkpoint's file; none for other names.
std::optional<std::int64_t> step_in_name(const std::filesystem::path& file);

// Steps of which any file is there, or all files; the newest first.
std::vector<std::int64_t> steps_found(const std::filesystem::path& folder);
std::vector<std::int64_t> steps_complete(const std::filesystem::path& folder,
                                         const std::vector<Role>& roles);

// Takes away what is older than the newest complete ones that are kept.
void prune_checkpoints(const std::filesystem::path& folder,
                       const std::vector<Role>& roles);

// Takes away all that are newer than a step, and what a kill left half-written.
void clear_checkpoints_after(const std::filesystem::path& folder, std::int64_t step);

// Where a run goes on.
struct RestartPoint {
    std::filesystem::path folder;  // of the checkpoint's files
    StateHeader header;
    std::vector<std::string> skipped;  // newer ones that "latest" could not use, and why
};

// wanted: "latest" of the run folder, or any one file of a checkpoint. Every file of the
// checkpoint is read through. Throws std::invalid_argument, one line, when there is none,
// when the one that was named is torn or half of it is missing (latest goes on to the one
// before), or when it is of another scene; scenes may differ in time.end.
RestartPoint find_restart(const std::string& wanted,
                          const std::filesystem::path& run_folder, const RunPlan& plan);

// Where its files are.
std::filesystem::path restart_folder(const std::string& wanted,
                                     const std::filesystem::path& run_folder);

}  // namespace magfsi::coupler
