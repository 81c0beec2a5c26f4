// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi explain: what a scene will do, before it does it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "adapters/magfsi/participants.h"
#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Effects in step order and those absent; SI and lattice values side by side; memory on
// these ranks, or on one.
std::string explain(const scene::Scene& scene, const Ranks& ranks = {});

// Those that it has.
std::vector<std::string> warnings(const std::string& explanation);

// For programs: name, scene_hash (as in summary.json), version of magfsi, ranks by role,
// machine, with a fluid its spacing_m and step_s, with bodies in motion their steps, on a
// calibrated machine what is predicted; what explain warns of, and all values in SI.
nlohmann::ordered_json facts(const scene::Scene& scene, const Ranks& ranks);

}  // namespace magfsi::launch
