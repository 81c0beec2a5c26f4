// SPDX-License-Identifier: GPL-2.0-or-later
// Faults of a scene: where one was found and how it is reported, in one line "where:
// found ...; allowed ...; suggestion".
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
    int line = 0;  // counted from 1; 0: no line
    int column = 0;
};
// "file:line:column", or the source alone without a line.
std::string to_string(const Origin& origin);

// A fault whose place is not known yet. `allowed` and `suggestion` may be empty.
class Complaint : public std::runtime_error {
  public:
    Complaint(std::string_view found, std::string_view allowed,
              std::string_view suggestion = {});
};

// Throws SceneError with the place and the complaint.
[[noreturn]] void refuse(const Origin& where, const Complaint& complaint);
[[noreturn]] inline void refuse(const Origin& where, std::string_view found,
                                std::string_view allowed,
                                std::string_view suggestion = {}) {
    refuse(where, Complaint(found, allowed, suggestion));
}

// Text of the user in quotes, cut to 48 bytes, without breaking a UTF-8 character.
std::string in_quotes(std::string_view text);

// Makes text of a file safe for a terminal: each byte that is not valid UTF-8 and each
// control character except line breaks becomes "?".
std::string printable(std::string_view text);

// Returns the candidate with the smallest edit distance, or "" if none is near.
// Insertions, deletions, substitutions and swapped neighbours count 1, a difference of
// case only 1/2.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// Suggestion "did you mean \"X\"?" with the nearest candidate, or "" if none is near.
std::string did_you_mean(std::string_view word,
                         const std::vector<std::string>& candidates);

}  // namespace magfsi::scene
