// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas of the time, read by muParser (https://beltoforion.de/en/muparser).
#pragma once

#include <array>
#include <string>

namespace magfsi::structure {

// Of the time t. written: with units, as the scene has it. si: in numbers of SI, a word
// without spaces, from which it is evaluated.
struct Formula {
    std::string written{"0"}, si{"0"};
};

// Value in SI. Throws std::runtime_error that names formula and time where it is no
// finite number, and std::invalid_argument where the text is no formula. A text is
// compiled at its first use and kept.
double value_at(const std::string& si, double time_s);

std::array<double, 3> value_at(const std::array<Formula, 3>& component, double time_s);

// Of a motion by formulas: from where it is at time 0 [m], and its first and second
// derivative by time [m/s, m/s2].
std::array<double, 3> displacement(const std::array<Formula, 3>& place_m, double time_s);
std::array<double, 3> velocity(const std::array<Formula, 3>& place_m, double time_s);
std::array<double, 3> acceleration(const std::array<Formula, 3>& place_m, double time_s);

// As value_at of one, but NaN and infinity come back as they are.
double value_or_nan(const std::string& si, double time_s);

// How such a value is called: "not a number" or "infinite".
const char* fault_of(double value);

}  // namespace magfsi::structure
