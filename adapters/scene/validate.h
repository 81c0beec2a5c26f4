// Compares a tree with the field table, key by key, in the file's order.
#pragma once

#include "adapters/scene/document.h"
#include "adapters/scene/field.h"

namespace magfsi::scene {

// Throws SceneError at the first unknown or missing key, wrong node kind, value that
// cannot be read or that leaves its range, and at alternatives given twice or not at all.
void validate(const Node& node, const Field& field);

}  // namespace magfsi::scene
