#include "structure/lammps/effects/prescribed_motion/motion_law.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <set>

#include "structure/lammps/law_words.h"
#include "structure/refuse.h"

namespace magfsi::structure {

template <>
constexpr const char* law_name<Oscillation> = "oscillation";
template <>
constexpr const char* law_name<DisplacementRamp> = "ramp";

namespace {

using std::numbers::pi;

Vec3 times(double factor, const Vec3& v) {
    return {factor * v[0], factor * v[1], factor * v[2]};
}

Vec3 displacement(const Oscillation& o, double time_s) {
    return times(
        std::sin(2 * pi * o.frequency_hz * time_s + o.phase_rad) - std::sin(o.phase_rad),
        o.amplitude_m);
}
Vec3 velocity(const Oscillation& o, double time_s) {
    const double omega = 2 * pi * o.frequency_hz;
    return times(omega * std::cos(omega * time_s + o.phase_rad), o.amplitude_m);
}

Vec3 way(const Oscillation& o) {
    return o.amplitude_m;
}
void check(const Oscillation& o) {
    if (!(o.frequency_hz > 0)) refuse("an oscillation needs a frequency above zero");
}

Vec3 displacement(const DisplacementRamp& r, double time_s) {
    if (time_s >= r.duration_s) return r.displacement_m;
    return times((1 - std::cos(pi * time_s / r.duration_s)) / 2, r.displacement_m);
}
Vec3 velocity(const DisplacementRamp& r, double time_s) {
    if (time_s >= r.duration_s) return {};
    const double rate = pi / r.duration_s;
    return times(rate * std::sin(rate * time_s) / 2, r.displacement_m);
}

Vec3 way(const DisplacementRamp& r) {
    return r.displacement_m;
}
void check(const DisplacementRamp& r) {
    if (!(r.duration_s > 0)) refuse("a ramp needs a duration above zero");
}

[[noreturn]] void refuse_face(const Body& body, const std::string& face,
                              const char* fault) {
    refuse("prescribed_motion of body {}: the face {} {}", body.name, face, fault);
}

const std::vector<int>& nodes_of(const Body& body, const std::string& face) {
    const auto found = body.mesh.faces.find(face);
    if (found != body.mesh.faces.end()) return found->second;
    refuse_face(body, face, "is none of its mesh");
}

// Nodes of faces that hold the body where it is, and those on rollers across the
// direction.
std::set<int> held_otherwise(const Body& body, const std::set<std::string>& moved,
                             const MotionCourse& course) {
    const Vec3 direction = std::visit([](const auto& c) { return way(c); }, course);
    std::set<int> held;
    for (const std::string& face : body.clamps) {
        if (moved.contains(face)) continue;
        const auto& nodes = nodes_of(body, face);
        held.insert(nodes.begin(), nodes.end());
    }
    for (const Roller& roller : body.rollers) {
        if (direction[static_cast<std::size_t>(roller.axis)] == 0) continue;
        for (const std::string& face : roller.faces) {
            const auto& nodes = nodes_of(body, face);
            held.insert(nodes.begin(), nodes.end());
        }
    }
    return held;
}

}  // namespace

std::vector<int> moved_nodes(const Body& body, const PrescribedMotion& motion) {
    std::set<int> nodes;
    for (const std::string& face : motion.faces) {
        const auto& more = nodes_of(body, face);
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
        const auto held = held_otherwise(body, faces[motion.body], motion.course);
        for (const int node : moved_nodes(body, motion)) {
            if (moved[motion.body].insert(node).second && !held.contains(node)) continue;
            refuse_face(
                body, fmt::format("{}", fmt::join(motion.faces, ", ")),
                "touches one that is held or moved differently; they must be apart");
        }
    }
}

Vec3 displacement_m(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return displacement(c, time_s); }, course);
}

Vec3 velocity_m_s(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return velocity(c, time_s); }, course);
}

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
