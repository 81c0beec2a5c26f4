// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers with units, and their dimensions.
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

// SI value with a handy prefix, "200 um", "17 mT", "1860 kg/m3".
std::string format_si(double value, std::string_view si_unit);

// "17 mT" with the SI unit "T" gives 0.017. The decimal exponent of the unit is folded
// into the number's text before it is rounded, so that 0.2 mm, 200 um and 2e-4 m are the
// same double. si_unit "" wants a plain number. Throws Complaint naming the expected
// dimension and the one found.
double parse_quantity(std::string_view text, std::string_view si_unit);

// The SI value of a number with any unit, and its dimension. Throws Complaint.
struct SiValue {
    double value = 0;
    Dimension dimension{};
};
SiValue parse_any_quantity(std::string_view text);

// Of m, g, s ... with or without a prefix; "mm2" is none.
bool is_unit_symbol(std::string_view text);

// "a length"; a product of base units for what has no name here.
std::string dimension_name(const Dimension& dimension);

// "a length such as 0.2 mm"
std::string dimension_expectation(std::string_view si_unit);

}  // namespace magfsi::scene
