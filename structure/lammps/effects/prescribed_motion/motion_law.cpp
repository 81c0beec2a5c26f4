// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/effects/prescribed_motion/motion_law.h"

#include "structure/lammps/motion_words.h"
#include "structure/refuse.h"

namespace magfsi::structure {

namespace {

void check(const Oscillation& o) {
    if (!(o.frequency_hz > 0)) refuse("an oscillation needs a frequency above zero");
}

void check(const DisplacementRamp& r) {
    if (!(r.duration_s > 0)) refuse("a ramp needs a duration above zero");
}

// A formula is checked as it is read.
void check(const FormulaMotion&) {}

}  // namespace

std::string motion_words(const MotionCourse& course) {
    return law_words(course);
}

MotionCourse motion_from(const std::vector<std::string>& words) {
    MotionCourse course;
    read_law(course, words);
    std::visit([](const auto& c) { check(c); }, course);
    return course;
}

}  // namespace magfsi::structure
