// SPDX-License-Identifier: GPL-2.0-or-later
// Reading and writing of numbers with units.
#pragma once

#include <string>
#include <string_view>

#include "adapters/scene/units.h"

namespace magfsi::scene {

// Formats an SI value with a suitable prefix: "200 um", "17 mT", "1860 kg/m3".
std::string format_si(double value, std::string_view si_unit);

// Reads a number with a unit: "17 mT" gives 0.017 for the SI unit "T". The decimal
// exponent of the unit is inserted into the number's text before rounding, so that 0.2
// mm, 200 um and 2e-4 m give the same double. For si_unit "" the text must be a plain
// number. A magnetisation may be given as remanence in T. Throws Complaint naming the
// expected dimension and the one found, and for sizes beyond anything plausible.
double parse_quantity(std::string_view text, std::string_view si_unit);

// Reads a number with any unit and returns its SI value and dimension. Throws Complaint.
struct SiValue {
    double value = 0;
    Dimension dimension{};
};
SiValue parse_any_quantity(std::string_view text);

}  // namespace magfsi::scene
