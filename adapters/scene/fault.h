// SPDX-License-Identifier: GPL-2.0-or-later
// Where a fault was found and how it is told: one line, "where: found ...; allowed ...;
// suggestion".
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/scene/reader.h"

namespace magfsi::scene {

// A place in a scene file, or a whole source such as "--set fluid.spacing" (line 0).
struct Origin {
    std::string source;
    int line = 0;  // from 1
    int column = 0;
};
std::string to_string(const Origin& origin);

// A fault before it is known where it stands. allowed and suggestion may be empty.
class Complaint : public std::runtime_error {
  public:
    Complaint(std::string_view found, std::string_view allowed,
              std::string_view suggestion = {});
};

[[noreturn]] void refuse(const Origin& where, const Complaint& complaint);
[[noreturn]] inline void refuse(const Origin& where, std::string_view found,
                                std::string_view allowed,
                                std::string_view suggestion = {}) {
    refuse(where, Complaint(found, allowed, suggestion));
}

// User text in quotes, shortened and without line breaks.
std::string in_quotes(std::string_view text);

// For a terminal: bytes of a file in it as they may stand there, one character for each
// that is no text or a control.
std::string printable(std::string_view text);

// The candidate with the smallest edit distance (insertions, deletions, substitutions and
// swapped neighbours; a difference of case only counts half), or "" when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// "did you mean X?", or "" when nothing is near.
std::string did_you_mean(std::string_view word,
                         const std::vector<std::string>& candidates);

}  // namespace magfsi::scene
