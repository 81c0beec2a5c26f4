// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/motion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <set>

#include "structure/refuse.h"

namespace magfsi::structure {

namespace {

using std::numbers::pi;

// Displacement, velocity and acceleration of each kind of course, and `way`, a vector
// with a component other than 0 along each axis on which the course moves its nodes.
Vec3 displacement(const Oscillation& o, double time_s) {
    return (std::sin(2 * pi * o.frequency_hz * time_s + o.phase_rad) -
            std::sin(o.phase_rad)) *
           o.amplitude_m;
}
Vec3 velocity(const Oscillation& o, double time_s) {
    const double omega = 2 * pi * o.frequency_hz;
    return omega * std::cos(omega * time_s + o.phase_rad) * o.amplitude_m;
}

Vec3 acceleration(const Oscillation& o, double time_s) {
    const double omega = 2 * pi * o.frequency_hz;
    return -omega * omega * std::sin(omega * time_s + o.phase_rad) * o.amplitude_m;
}

Vec3 way(const Oscillation& o) {
    return o.amplitude_m;
}

Vec3 displacement(const DisplacementRamp& r, double time_s) {
    if (time_s >= r.duration_s) return r.displacement_m;
    return (1 - std::cos(pi * time_s / r.duration_s)) / 2 * r.displacement_m;
}
Vec3 velocity(const DisplacementRamp& r, double time_s) {
    if (time_s >= r.duration_s) return {};
    const double rate = pi / r.duration_s;
    return rate * std::sin(rate * time_s) / 2 * r.displacement_m;
}

Vec3 acceleration(const DisplacementRamp& r, double time_s) {
    if (time_s >= r.duration_s) return {};
    const double rate = pi / r.duration_s;
    return rate * rate * std::cos(rate * time_s) / 2 * r.displacement_m;
}

Vec3 way(const DisplacementRamp& r) {
    return r.displacement_m;
}

Vec3 displacement(const FormulaMotion& f, double time_s) {
    return displacement(f.component_m, time_s);
}
Vec3 velocity(const FormulaMotion& f, double time_s) {
    return velocity(f.component_m, time_s);
}
Vec3 acceleration(const FormulaMotion& f, double time_s) {
    return acceleration(f.component_m, time_s);
}

// A formula other than the plain 0 counts as motion along its axis.
Vec3 way(const FormulaMotion& f) {
    Vec3 out{};
    for (std::size_t d = 0; d < 3; ++d) out[d] = f.component_m[d].si == "0" ? 0 : 1;
    return out;
}

// It moves no more after time 0.
Vec3 displacement(const HeldDisplacement&, double) {
    return {};
}
Vec3 velocity(const HeldDisplacement&, double) {
    return {};
}
Vec3 acceleration(const HeldDisplacement&, double) {
    return {};
}
Vec3 way(const HeldDisplacement& held) {
    return held.displacement_m;
}

// A turn moves nodes along all axes of space but its own.
Vec3 displacement(const TurningMotion&, double) {
    return {};
}
Vec3 velocity(const TurningMotion&, double) {
    return {};
}
Vec3 acceleration(const TurningMotion&, double) {
    return {};
}

Vec3 way(const TurningMotion& turning) {
    Vec3 out{};
    for (std::size_t d = 0; d < 3; ++d) {
        Vec3 across = turning.axis;
        across[d] = 0;
        out[d] = norm(across) > 1e-12 * norm(turning.axis) ? 1 : 0;
    }
    return out;
}

// The angle [rad] of a turn, or a derivative of it, by the functions of a displacement
// along x: an oscillation's by one with this amplitude in place of metres.
Oscillation as_displacement(const AngleOscillation& o) {
    return {{o.amplitude_rad, 0, 0}, o.frequency_hz, o.phase_rad};
}
FormulaMotion as_displacement(const Formula& angle) {
    return {{angle, Formula{}, Formula{}}};
}

template <class Derivative>
Turn turn_of(const MotionCourse& course, const Derivative& derivative) {
    const auto* turning = std::get_if<TurningMotion>(&course);
    if (!turning) return {};
    const double angle = std::visit(
        [&](const auto& a) { return derivative(as_displacement(a))[0]; }, turning->angle);
    return {angle / norm(turning->axis) * turning->axis, turning->about_m};
}

// sin(x) / x
double sinc(double x) {
    return x == 0 ? 1 : std::sin(x) / x;
}

// True if a node is held along all axes, or along one on which the motion would move it.
bool holds(const HeldAxes& held, const Vec3& way) {
    if (held == HeldAxes{true, true, true}) return true;
    return (held[0] && way[0] != 0) || (held[1] && way[1] != 0) ||
           (held[2] && way[2] != 0);
}

}  // namespace

std::vector<int> moved_nodes(const Body& body, const PrescribedMotion& motion) {
    std::set<int> nodes;
    for (const std::string& face : motion.faces) {
        const auto& more = face_nodes(body, face, "moved");
        nodes.insert(more.begin(), more.end());
    }
    return {nodes.begin(), nodes.end()};
}

void check_motions(const std::vector<Body>& bodies,
                   const std::vector<PrescribedMotion>& motions) {
    std::vector<std::set<std::string>> faces(bodies.size());
    for (const PrescribedMotion& motion : motions)
        faces[motion.body].insert(motion.faces.begin(), motion.faces.end());
    std::vector<std::set<int>> moved(bodies.size());
    for (const PrescribedMotion& motion : motions) {
        const Body& body = bodies[motion.body];
        const std::vector<HeldAxes> held = held_axes(body, faces[motion.body]);
        if (const auto* turning = std::get_if<TurningMotion>(&motion.course);
            turning && !(norm(turning->axis) > 0))
            refuse(
                "prescribed_motion of body {}: found an axis of length 0; give it a "
                "direction such as [0, 1, 0]",
                body.name);
        const Vec3 its_way =
            std::visit([](const auto& c) { return way(c); }, motion.course);
        for (const int node : moved_nodes(body, motion)) {
            if (moved[motion.body].insert(node).second && !holds(held[node], its_way))
                continue;
            refuse(
                "prescribed_motion of body {}: the face {} touches one that is held or "
                "moved differently; they must be apart",
                body.name, fmt::join(motion.faces, ", "));
        }
    }
}

Vec3 displacement_m(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return displacement(c, time_s); }, course);
}

Vec3 start_displacement_m(const MotionCourse& course) {
    const auto* held = std::get_if<HeldDisplacement>(&course);
    return held ? held->displacement_m : Vec3{};
}

Vec3 velocity_m_s(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return velocity(c, time_s); }, course);
}

Vec3 acceleration_m_s2(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return acceleration(c, time_s); }, course);
}

Turn turn_rad(const MotionCourse& course, double time_s) {
    return turn_of(course, [&](const auto& c) { return displacement(c, time_s); });
}

Turn turn_rate_rad_s(const MotionCourse& course, double time_s) {
    return turn_of(course, [&](const auto& c) { return velocity(c, time_s); });
}

Turn turn_acceleration_rad_s2(const MotionCourse& course, double time_s) {
    return turn_of(course, [&](const auto& c) { return acceleration(c, time_s); });
}

// Rodrigues' formula, sin(a) k x r + (1 - cos(a)) k x (k x r) with the unit vector k, in
// a form that loses no digits at small angles a.
Vec3 turned_by_m(const Vec3& turn, const Vec3& arm_m) {
    const double angle = norm(turn), half = sinc(angle / 2);
    const Vec3 across = cross(turn, arm_m);
    return sinc(angle) * across + half * half / 2 * cross(turn, across);
}

// Beside the acceleration along the way, that towards the axis.
Vec3 node_acceleration_m_s2(const MotionCourse& course, const Vec3& place_m,
                            double time_s) {
    const Turn rate = turn_rate_rad_s(course, time_s);
    const Vec3 arm_m = place_m - rate.about_m;
    return acceleration_m_s2(course, time_s) +
           cross(turn_acceleration_rad_s2(course, time_s).vector, arm_m) +
           cross(rate.vector, cross(rate.vector, arm_m));
}

}  // namespace magfsi::structure
