// The error of a run by a sibling: an earlier run of the same scene at another
// resolution.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

// The same for scenes that differ in fluid.spacing, the elements of meshes, the fluid's
// step and what is written only: 16 hexadecimal digits, for summary.json.
std::string family(const scene::Scene& scene);

// {family, edge_m: {fluid, a body's name, ...}}: what a later sibling looks for.
nlohmann::ordered_json resolution_of(const scene::Scene& scene);

// Estimates for the run in `out`, whose summary holds resolution_of, by the best of the
// completed runs in folders beside it: for each probe the error of its final value and of
// its largest one, over the largest magnitude. With the order p assumed, 2 for a solver
// alone and 1 where a body meets a fluid, the difference d of two runs whose edges have
// the ratio r leaves d / (r^p - 1) to the finer one and r^p times that to the coarser.
// Null where there is no sibling.
nlohmann::ordered_json richardson(const scene::Scene& scene,
                                  const std::filesystem::path& out);

// One line of the largest estimates.
std::string richardson_line(const nlohmann::ordered_json& estimate);

}  // namespace magfsi::launch
