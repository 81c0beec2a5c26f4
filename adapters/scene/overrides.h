// --set path.to.key=value, applied to the tree before it is read.
#pragma once

#include <string>
#include <vector>

#include "adapters/scene/document.h"

namespace magfsi::scene {

// value is YAML. A missing key is created with the maps above it; an item of a list is
// addressed by its number from 0; an empty value or null removes the key. What was not
// overridden keeps its place in the file; what was is reported as "--set path.to.key".
void apply_overrides(Node& root, const std::vector<std::string>& overrides);

}  // namespace magfsi::scene
