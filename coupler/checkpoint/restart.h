// Where a run goes on: --restart latest, or --restart FILE.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/checkpoint/state_header.h"
#include "coupler/participants/run_plan.h"

namespace magfsi::coupler {

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
                          const std::filesystem::path& run_folder,
                          const RunPlan& plan);

// Where its files are.
std::filesystem::path restart_folder(const std::string& wanted,
                                     const std::filesystem::path& run_folder);

}  // namespace magfsi::coupler
