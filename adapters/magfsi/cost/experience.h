// How long paths of equilibria took on this machine: how many iterations they need shows
// only when they run. Kept beside the calibration.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace magfsi::launch {

// Of the scene with this hash.
std::optional<double> experienced_wall_s(std::uint64_t scene_hash);

// Does nothing where the folder cannot be written: it is a convenience.
void keep_experience(std::uint64_t scene_hash, double wall_s);

}  // namespace magfsi::launch
