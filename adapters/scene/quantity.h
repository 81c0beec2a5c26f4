// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers with units.
#pragma once

#include <string>
#include <string_view>

#include "adapters/scene/units.h"

namespace magfsi::scene {

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

}  // namespace magfsi::scene
