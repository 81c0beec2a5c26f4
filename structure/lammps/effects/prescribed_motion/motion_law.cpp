#include "structure/lammps/effects/prescribed_motion/motion_law.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

namespace magfsi::structure {

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

Vec3 displacement(const DisplacementRamp& r, double time_s) {
    if (time_s >= r.duration_s) return r.displacement_m;
    return times((1 - std::cos(pi * time_s / r.duration_s)) / 2, r.displacement_m);
}
Vec3 velocity(const DisplacementRamp& r, double time_s) {
    if (time_s >= r.duration_s) return {};
    const double rate = pi / r.duration_s;
    return times(rate * std::sin(rate * time_s) / 2, r.displacement_m);
}

std::string words_of(const Oscillation& o) {
    return fmt::format("oscillation {:.17g} {:.17g} {:.17g}",
                       fmt::join(o.amplitude_m, " "), o.frequency_hz, o.phase_rad);
}
std::string words_of(const DisplacementRamp& r) {
    return fmt::format("ramp {:.17g} {:.17g}", fmt::join(r.displacement_m, " "),
                       r.duration_s);
}

[[noreturn]] void refuse(const std::vector<std::string>& words) {
    throw std::invalid_argument(
        fmt::format("the motion \"{}\" found, oscillation AX AY AZ FREQUENCY PHASE or "
                    "ramp DX DY DZ DURATION is allowed",
                    fmt::join(words, " ")));
}

std::vector<double> numbers_in(const std::vector<std::string>& words) {
    std::vector<double> numbers;
    for (std::size_t i = 1; i < words.size(); ++i) {
        std::size_t read = 0;
        try {
            numbers.push_back(std::stod(words[i], &read));
        } catch (const std::exception&) {
            refuse(words);
        }
        if (read != words[i].size()) refuse(words);
    }
    return numbers;
}

[[noreturn]] void refuse_face(const Body& body, const std::string& face,
                              const char* fault) {
    throw std::invalid_argument(fmt::format(
        "prescribed_motion of body {}: the face {} {}", body.name, face, fault));
}

const std::vector<int>& nodes_of(const Body& body, const std::string& face) {
    const auto found = body.mesh.faces.find(face);
    if (found != body.mesh.faces.end()) return found->second;
    refuse_face(body, face, "is none of its mesh");
}

// Nodes of faces that hold the body where it is, and those on rollers across the way.
std::set<int> held_otherwise(const Body& body, const std::set<std::string>& moved,
                             const Vec3& way) {
    std::set<int> held;
    for (const std::string& face : body.clamps) {
        if (moved.contains(face)) continue;
        const auto& nodes = nodes_of(body, face);
        held.insert(nodes.begin(), nodes.end());
    }
    for (const Roller& roller : body.rollers) {
        if (way[static_cast<std::size_t>(roller.axis)] == 0) continue;
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
        const auto held =
            held_otherwise(body, faces[motion.body], direction(motion.course));
        for (const int node : moved_nodes(body, motion)) {
            if (moved[motion.body].insert(node).second && !held.contains(node)) continue;
            refuse_face(body, fmt::format("{}", fmt::join(motion.faces, ", ")),
                        "touches one that is held or moved differently; they must be "
                        "apart");
        }
    }
}

Vec3 displacement_m(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return displacement(c, time_s); }, course);
}

Vec3 velocity_m_s(const MotionCourse& course, double time_s) {
    return std::visit([&](const auto& c) { return velocity(c, time_s); }, course);
}

Vec3 direction(const MotionCourse& course) {
    const auto* oscillation = std::get_if<Oscillation>(&course);
    return oscillation ? oscillation->amplitude_m
                       : std::get<DisplacementRamp>(course).displacement_m;
}

std::string motion_words(const MotionCourse& course) {
    return std::visit([](const auto& c) { return words_of(c); }, course);
}

MotionCourse motion_from(const std::vector<std::string>& words) {
    const std::vector<double> n = numbers_in(words);
    if (words.size() == 6 && words[0] == "oscillation" && n[3] > 0)
        return Oscillation{{n[0], n[1], n[2]}, n[3], n[4]};
    if (words.size() == 5 && words[0] == "ramp" && n[3] > 0)
        return DisplacementRamp{{n[0], n[1], n[2]}, n[3]};
    refuse(words);
}

}  // namespace magfsi::structure
