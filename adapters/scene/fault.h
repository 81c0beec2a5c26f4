// Where a fault was found and how it is told: one line, "where: found ...; allowed ...;
// suggestion".
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

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

}  // namespace magfsi::scene
