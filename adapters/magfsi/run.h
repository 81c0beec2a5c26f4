// magfsi run: checks the scene, starts its participants as one MPI job, names how it
// ended.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace magfsi::launch {

struct RunOptions {
    std::filesystem::path scene;
    std::filesystem::path out;
    std::vector<std::string> overrides;
    std::map<std::string, int> ranks;  // structure, fluid
    std::string restart;               // latest, a file of a checkpoint, or empty
};

// The exit code of the command line. Throws scene::SceneError on bad input.
int run(const RunOptions& options);

// "structure=1,fluid=2". Throws std::invalid_argument.
std::map<std::string, int> parse_ranks(const std::string& text);

}  // namespace magfsi::launch
