// SPDX-License-Identifier: GPL-2.0-or-later
// Units, their symbols and prefixes, and names of dimensions.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace magfsi::scene {

// Exponents of kg, m, s, A and rad. The angle is a dimension of its own, so that a phase
// of "45" or "45 mm" is refused.
using Dimension = std::array<int, 5>;

// A unit: SI value = number * factor * 10^decimal_exponent. The power of ten is separate,
// so that it can be written into the number's text, which makes 0.2 mm and 200 um the
// same double.
struct Unit {
    Dimension dimension{};
    int decimal_exponent = 0;
    long double factor = 1;  // not 1 for min, h, deg
};

// Reads a unit such as "mm", "kg/m3", "m/s^2", "1/s", "kA/m", "N m", "mm2/s"; "" is a
// plain number. Each "/" divides by the next factor only, and no product may follow it.
// Throws Complaint.
Unit parse_unit(std::string_view text);

// True for one of the symbols m, g, s ... with or without a prefix; not for "mm2".
bool is_unit_symbol(std::string_view text);

// Advice about text that is no unit or number, or "".
std::string remedy(std::string_view text);

// Name of a dimension such as "a length", or a product of base units if it has no name
// here.
std::string dimension_name(const Dimension& dimension);

// Description for errors, with an example: "a length such as 0.2 mm".
std::string dimension_expectation(std::string_view si_unit);

}  // namespace magfsi::scene
