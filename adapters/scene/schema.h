// SPDX-License-Identifier: GPL-2.0-or-later
// What the field table says, for machines and for readers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace magfsi::scene {

// JSON Schema (draft 2020-12) of the scene file.
nlohmann::ordered_json scene_schema();

// docs/scene.md: every key with its unit, range, default and meaning.
std::string scene_reference_markdown();

}  // namespace magfsi::scene
