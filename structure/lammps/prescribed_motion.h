// How a face of a body moves that something outside holds and drives: displacement from
// where it starts, zero at time 0.
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

// The nodes of a body's motion, ascending. Throws std::invalid_argument on a face that
// the mesh lacks.
std::vector<int> moved_nodes(const Body& body, const PrescribedMotion& motion);

// Throws std::invalid_argument, naming body and face, where a node is moved twice, also
// held by a face that is not moved, or on rollers across its way.
void check_motions(const std::vector<Body>& bodies,
                   const std::vector<PrescribedMotion>& motions);

Vec3 displacement_m(const MotionCourse& course, double time_s);
Vec3 velocity_m_s(const MotionCourse& course, double time_s);
Vec3 direction(const MotionCourse& course);  // of any length

// As words of fix magttice/motion, and back: "oscillation AX AY AZ FREQUENCY PHASE",
// "ramp DX DY DZ DURATION". Throws std::invalid_argument on other words.
std::string motion_words(const MotionCourse& course);
MotionCourse motion_from(const std::vector<std::string>& words);

}  // namespace magfsi::structure
