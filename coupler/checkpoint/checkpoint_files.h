// The checkpoints of a run folder: checkpoint_STEP_structure.h5 and
// checkpoint_STEP_fluid.h5, of each participant that the scene has. One is complete when
// all its files have their names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "coupler/participants/world.h"

namespace magfsi::coupler {

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

}  // namespace magfsi::coupler
