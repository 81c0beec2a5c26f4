// SPDX-License-Identifier: GPL-2.0-or-later
// Units, their symbols and prefixes, and the names of their dimensions.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace magfsi::scene {

// Exponents of kg, m, s, A and rad. The angle counts as a dimension of its own, so that a
// phase of 45 or 45 mm is refused.
using Dimension = std::array<int, 5>;

// SI value = number * factor * 10^decimal_exponent. The power of ten is kept apart so
// that it can be written into the number's text, which makes 0.2 mm and 200 um the same
// double.
struct Unit {
    Dimension dimension{};
    int decimal_exponent = 0;
    long double factor = 1;  // min, h, deg
};

// "mm", "kg/m3", "m/s^2", "1/s", "kA/m", "N m", "mm2/s". "" is the plain number. Each "/"
// divides by the next factor only, and no product may follow it. Throws Complaint.
Unit parse_unit(std::string_view text);

// True for one of the symbols m, g, s ... with or without a prefix; "mm2" is none.
bool is_unit_symbol(std::string_view text);

// What to do about text that is no unit or number, or "".
std::string remedy(std::string_view text);

// "a length"; a product of base units for what has no name here.
std::string dimension_name(const Dimension& dimension);

// "a length such as 0.2 mm"
std::string dimension_expectation(std::string_view si_unit);

}  // namespace magfsi::scene
