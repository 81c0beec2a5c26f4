// The command line that every participant understands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/output/progress.h"

namespace magfsi::coupler {

struct ParticipantArguments {
    std::filesystem::path scene;
    std::filesystem::path out;  // run folder; default runs/NAME of the scene
    std::vector<std::string> overrides;
    std::vector<std::string> notes;  // for the head of the log
    std::string restart;             // "latest", a file of a checkpoint, or empty
    int halvings = 0;                // of every step, by a retry
    bool record = false;             // what both sides tell each other, to play it later
    std::filesystem::path replay;    // the record that a replay participant plays
    output::ProgressMode progress = output::ProgressMode::plain;
    bool help = false;
    std::string help_text;
};

// Throws std::invalid_argument naming the option.
ParticipantArguments parse_arguments(int argc, char** argv,
                                     const std::string& description);

// The run folder when none was given.
std::filesystem::path default_out(const std::string& scene_name);

}  // namespace magfsi::coupler
