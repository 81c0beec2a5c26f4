// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of the courses of prescribed motion, and their largest speeds.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "adapters/scene/checks.h"
#include "adapters/scene/field.h"

namespace magfsi::scene {
namespace {

// Largest rate of a turn within the run [rad/s], of a formula by samples.
double largest_rate_rad_s(const TurningMotion& turning, double end_s) {
    if (const auto* o = std::get_if<AngleOscillation>(&turning.angle))
        return 2 * std::numbers::pi * o->frequency_hz * std::abs(o->amplitude_rad);
    const std::array<Formula, 3> angle{std::get<Formula>(turning.angle), {}, {}};
    double largest = 0;
    for (int i = 0; i <= 1000; ++i)
        largest = std::max(largest, norm(velocity(angle, end_s * i / 1000)));
    return largest;
}

// Largest distance of a corner of the block, as it is placed, from the axis of a turn; 0
// for other meshes.
double farthest_from_axis_m(const Body& body, const TurningMotion& turning) {
    const auto* box = std::get_if<Box>(&body.mesh);
    if (!box) return 0;
    const Vec3 centre =
        body.initial.position_m ? *body.initial.position_m : 0.5 * box->size_m;
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 arm = 0.5 * box->size_m;
        for (int d = 0; d < 3; ++d)
            if ((corner >> d) % 2 == 1) arm[d] = -arm[d];
        if (const auto& turn = body.initial.rotation) {
            const auto [a, b] = turn->plane;
            const double c = std::cos(turn->angle_rad), s = std::sin(turn->angle_rad);
            const double along = c * arm[a] - s * arm[b];
            arm[b] = s * arm[a] + c * arm[b];
            arm[a] = along;
        }
        const Vec3 across = cross(turning.axis, centre + arm - turning.about_m);
        farthest = std::max(farthest, norm(across) / norm(turning.axis));
    }
    return farthest;
}

}  // namespace

void check_course(const MotionCourse& course, double end_s, const CourseMarks& at) {
    if (const auto* way = std::get_if<FormulaMotion>(&course)) {
        constexpr std::array<const char*, 3> components{"x", "y", "z"};
        for (std::size_t d = 0; d < 3; ++d)
            largest_size(way->component_m[d], end_s, at("formula", components[d]));
    }
    const auto* turning = std::get_if<TurningMotion>(&course);
    if (!turning) return;
    require(norm(turning->axis) > 0, at("turning", "axis"), "an axis of length 0",
            "any other vector such as [0, 1, 0]");
    if (const auto* angle = std::get_if<Formula>(&turning->angle))
        largest_size(*angle, end_s, at("turning", "angle"));
}

// Peak speeds: 2 pi f A of an oscillation, pi / 2 of the mean speed of a ramp by (1 -
// cos) / 2, sampled for formulas and turns. The speed of a turn is that of the block's
// farthest corner; of other meshes, whose extent is not known here, it is not checked.
double largest_speed_m_s(const Body& body, const MotionCourse& course, double end_s) {
    constexpr double pi = std::numbers::pi;
    if (const auto* turning = std::get_if<TurningMotion>(&course))
        return largest_rate_rad_s(*turning, end_s) * farthest_from_axis_m(body, *turning);
    if (const auto* o = std::get_if<Oscillation>(&course))
        return 2 * pi * o->frequency_hz * norm(o->amplitude_m);
    if (const auto* ramp = std::get_if<DisplacementRamp>(&course))
        return pi / 2 * norm(ramp->displacement_m) / ramp->duration_s;
    if (std::holds_alternative<HeldDisplacement>(course)) return 0;
    const auto& formula = std::get<FormulaMotion>(course);
    double largest = 0;
    for (int i = 0; i <= 1000; ++i)
        largest =
            std::max(largest, norm(velocity(formula.component_m, end_s * i / 1000)));
    return largest;
}

}  // namespace magfsi::scene
