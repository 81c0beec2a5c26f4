// Is the text one YAML document?
#pragma once

#include <string>

#include "adapters/scene/fault.h"

namespace magfsi::scene {

// Throws SceneError at a syntax error or a second document. Looks at nothing else, so
// that a bracket left open is told as such: yaml-cpp reports maps in its place before it
// fails.
void check_syntax(const std::string& text, const Origin& whole);

}  // namespace magfsi::scene
