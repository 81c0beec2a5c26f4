// How a face of a body moves that something outside holds and drives: displacement from
// where it starts, zero at time 0. The effect prescribed_motion acts on it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

// amplitude (sin(2 pi f t + phase) - sin(phase)). Phase 0: at full speed at once, to
// both sides of the start; -pi / 2: from rest, to one side.
struct Oscillation {
    Vec3 amplitude_m{};
    double frequency_hz = 0;
    double phase_rad = 0;
};

// To the displacement within the duration, by (1 - cos(pi t / duration)) / 2; stays
// there.
struct DisplacementRamp {
    Vec3 displacement_m{};
    double duration_s = 0;
};

using MotionCourse = std::variant<Oscillation, DisplacementRamp>;

// Of faces that are among the body's clamps.
struct PrescribedMotion {
    std::size_t body = 0;  // of LammpsInput::bodies
    std::vector<std::string> faces;
    MotionCourse course;
};

}  // namespace magfsi::structure
