// SPDX-License-Identifier: GPL-2.0-or-later
// Course of a prescribed motion as words of a command.
#pragma once

#include <string>
#include <vector>

#include "structure/motion.h"

namespace magfsi::structure {

// The course as words of fix magttice/motion and of a part of fix magttice/rigid, and
// back: "oscillation AX AY AZ FREQUENCY PHASE", "ramp DX DY DZ DURATION", "formula UX UY
// UZ", "held DX DY DZ", or "turning KX KY KZ PX PY PZ" (axis and its point) with
// "oscillation ANGLE FREQUENCY PHASE" or "angle FORMULA" behind it, in SI and radians.
// motion_from throws std::invalid_argument on other words.
std::string motion_words(const MotionCourse& course);
MotionCourse motion_from(const std::vector<std::string>& words);

}  // namespace magfsi::structure
