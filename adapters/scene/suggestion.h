// Near names for what was mistyped.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace magfsi::scene {

// The candidate with the smallest edit distance (insertions, deletions, substitutions and
// swapped neighbours; a difference of case only counts half), or "" when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// "did you mean X?", or "" when nothing is near.
std::string did_you_mean(std::string_view word,
                         const std::vector<std::string>& candidates);

}  // namespace magfsi::scene
