// What users say about the six sides of the box; part of fluid.h. SI.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>

namespace magfsi::fluid {

using Vec3 = std::array<double, 3>;

enum class BoundaryKind {
    periodic,         // with the opposite side
    no_slip,          // at rest, or moving along itself with wall_velocity_m_s
    free_slip,        // no flow through, no shear: a plane of symmetry
    velocity_inlet,   // prescribed velocity, in or out
    pressure_outlet,  // lets flow and sound out
};

std::string to_string(BoundaryKind kind);

// How an inlet's velocity varies over its opening. Along an axis that is periodic or has
// free slip at an end it does not fall there. With s the distance from the middle over
// half the width (radius of a disc), rectangles take the product over both axes:
enum class InletProfile {
    uniform,
    parabolic,  // 1 - s^2
    plug,       // 1 - s^8: flat, falling to zero over the outer fifth
};

struct Inlet {
    Vec3 velocity_m_s{};  // mean over the cells of the opening, whatever the profile
    InletProfile profile = InletProfile::uniform;
    double ramp_s = 0;  // grows from rest as (1 - cos(pi t / ramp)) / 2
    // Replaces all of the above: velocity [m/s] at the centre of a cell's face on the
    // side [m], at a time [s] after the start. Called in every step for every such face.
    std::function<Vec3(const Vec3& position_m, double time_s)> course;
};

// Openings of a side, in its plane: coordinates along the two other axes in the order x,
// y, z, from the box's lowest corner. A cell belongs if the centre of its face does.
struct Rectangle {
    std::array<double, 2> centre_m{}, size_m{};
};
struct Disc {
    std::array<double, 2> centre_m{};
    double diameter_m = 0;
};
using Patch = std::variant<Rectangle, Disc>;

struct Boundary {
    BoundaryKind kind = BoundaryKind::periodic;
    Vec3 wall_velocity_m_s{};       // no_slip only; tangential
    Inlet inlet{};                  // velocity_inlet only
    double outlet_pressure_pa = 0;  // pressure_outlet only; gauge
    // Inlets and outlets: the part of the side that is open; the rest is a wall at rest.
    std::optional<Patch> patch{};
};

}  // namespace magfsi::fluid
