// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi explain: describes what a run of a scene will do, before it runs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "adapters/app/participants.h"
#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Text for people: effects in step order and those absent, values in SI and lattice units
// side by side, bodies, coupling and files. Memory is given for the ranks, or for one
// rank where `ranks` has none. Builds the meshes; throws std::invalid_argument where the
// run would refuse the scene.
std::string explain(const scene::Scene& scene, const bodies::Solids& solids,
                    const Ranks& ranks = {});

// Lines of the explanation that begin with "warning: ", without that prefix.
std::vector<std::string> warnings(const std::string& explanation);
// The explanation has a line for each surface from a file: triangles, parts, extent,
// volume. This returns them.
std::vector<std::string> surfaces(const std::string& explanation);

// JSON object for programs: name, scene_hash (as in summary.json), version, machine,
// ranks by role; spacing_m and step_s of a fluid; steps of moving bodies; the predicted
// cost on a calibrated machine; the warnings in `explained`, the text of explain(); and
// all values of the scene in SI units.
nlohmann::ordered_json facts(const scene::Scene& scene, const bodies::Solids& solids,
                             const Ranks& ranks, const std::string& explained);

}  // namespace magfsi::launch
