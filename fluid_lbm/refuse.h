// SPDX-License-Identifier: GPL-2.0-or-later
// Refusal of a configuration, and the names of axes and sides in such messages.
#pragma once

#include <sstream>
#include <stdexcept>

namespace magfsi::fluid {

inline constexpr const char* axis_name[3] = {"x", "y", "z"};
inline constexpr const char* side_name[6] = {"x_min", "x_max", "y_min",
                                             "y_max", "z_min", "z_max"};

// Throws std::invalid_argument with a text that joins the parts.
template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    throw std::invalid_argument(text.str());
}

}  // namespace magfsi::fluid
