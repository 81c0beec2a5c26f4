// SPDX-License-Identifier: GPL-2.0-or-later
// The unit that a file is likely in whose lengths are too large or too small as read: CAD
// programs and Gmsh write bare numbers, mostly of millimetres.
#pragma once

#include <string>
#include <utility>

namespace magfsi::words {

// Advice such as "unit: 1 mm?". size_m: longest edge as read with the unit unit_m [m];
// least_m, most_m: between these it would be sound.
inline std::string likely_unit(double size_m, double unit_m, double least_m,
                               double most_m) {
    for (const auto& [name, value_m] :
         {std::pair("1 mm", 1e-3), std::pair("1 m", 1.0), std::pair("1 cm", 1e-2),
          std::pair("1 um", 1e-6)}) {
        const double then_m = size_m * value_m / unit_m;
        if (value_m != unit_m && then_m >= least_m && then_m <= most_m)
            return std::string("unit: ") + name + "?";
    }
    return "see that its unit is the file's";
}

}  // namespace magfsi::words
