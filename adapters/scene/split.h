#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace magfsi::scene {

// The parts between the separators; one empty part of an empty text.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace magfsi::scene
