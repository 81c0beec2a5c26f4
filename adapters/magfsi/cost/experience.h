// How long paths of equilibria took on this machine: how many iterations they need shows
// only when they run. Kept beside the calibration.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

namespace magfsi::launch {

// Of the scene with this hash: seconds by ranks of the structure.
std::map<int, double> experienced_wall_s(std::uint64_t scene_hash);

// Of runs on the same ranks the fastest counts: what else the machine does only adds.
// Does nothing where the folder cannot be written: it is a convenience.
void keep_experience(std::uint64_t scene_hash, int ranks, double wall_s);

}  // namespace magfsi::launch
