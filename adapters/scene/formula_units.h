// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas of the time whose numbers carry units: "12 mT * sin(2*pi*25 Hz*t)".
#pragma once

#include <string>
#include <string_view>

namespace magfsi::scene {

// The same formula in numbers of SI, without spaces (structure/formula.h). A number takes
// the unit behind it; angles count as plain numbers. Throws Complaint where it is no
// formula or its value has not the dimension of si_unit at every time.
std::string formula_in_si(const std::string& text, std::string_view si_unit);

// "a speed such as 0.5 m/s, as a formula of the time t such as ..."
std::string formula_expectation(std::string_view si_unit);

}  // namespace magfsi::scene
