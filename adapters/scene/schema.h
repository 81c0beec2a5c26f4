// SPDX-License-Identifier: GPL-2.0-or-later
// The table of keys as JSON Schema and as a reference page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace magfsi::scene {

// JSON Schema (draft 2020-12) of the scene file.
nlohmann::ordered_json scene_schema();

// Text of docs/scene.md: every key with its unit, range, default and meaning.
std::string scene_reference_markdown();

}  // namespace magfsi::scene
