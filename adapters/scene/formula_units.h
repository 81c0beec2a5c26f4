// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas of the time whose numbers have units, such as "12 mT * sin(2*pi*25 Hz*t)".
#pragma once

#include <string>
#include <string_view>

namespace magfsi::scene {

// Converts a formula to plain SI numbers without spaces (as structure/formula.h reads
// it). The unit behind a number belongs to it; angles count as plain numbers. Throws
// Complaint if the text is no formula or if its value does not have the dimension of
// si_unit at all times.
std::string formula_in_si(const std::string& text, std::string_view si_unit);

// Description for errors: "a speed such as 0.5 m/s, as a formula of the time t such as
// ...".
std::string formula_expectation(std::string_view si_unit);

}  // namespace magfsi::scene
