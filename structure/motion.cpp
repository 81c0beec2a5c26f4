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

Vec3 velocity_m_s(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return velocity(c, time_s); }, course);
}

Vec3 acceleration_m_s2(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return acceleration(c, time_s); }, course);
}

}  // namespace magfsi::structure
