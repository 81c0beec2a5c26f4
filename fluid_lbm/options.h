// SPDX-License-Identifier: GPL-2.0-or-later
// Options of the fluid that a user chooses: collision, precision, sides of the box,
// obstacles. SI; coordinates count from the box's lowest corner. The scene file describes
// these types itself (adapters/scene/keys_fluid.cpp). Each enumeration is followed by its
// words in a scene, in the order of the enumerators.
#pragma once

#include <array>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/words/name_of.h"
#include "fluid_lbm/obstacle/shapes.h"
#include "fluid_lbm/rheology.h"

namespace magfsi::fluid {

// Collision operator. streaming/kernels.cpp maps each one to its kernel; automatic is
// replaced by the choice of collision/choice.h.
enum class Collision { automatic, bgk, trt, recursive_regularized, recursive_mrt };
constexpr auto words_of(Collision) {
    return std::to_array<std::string_view>(
        {"automatic", "bgk", "trt", "recursive_regularized", "recursive_mrt"});
}

// Type in which populations are stored and computed. float_ takes half the memory and
// time of double_.
enum class Precision { double_, float_ };
constexpr auto words_of(Precision) {
    return std::to_array<std::string_view>({"double", "float"});
}

// --- sides of the box ---------------------------------------------------------------

// Condition at one side of the box.
enum class BoundaryKind {
    periodic,         // joined to the opposite side
    no_slip,          // at rest, or moving along itself with wall_velocity_m_s
    free_slip,        // no flow through, no shear: a plane of symmetry
    velocity_inlet,   // prescribed velocity, in or out
    pressure_outlet,  // lets flow and sound out
// Kinds that only their effect knows follow from effects.inc.
#define MAGFSI_EFFECT(name)
#define MAGFSI_BOUNDARY(name) name,
#include "fluid_lbm/effects.inc"
#undef MAGFSI_BOUNDARY
};
constexpr auto words_of(BoundaryKind) {
#define MAGFSI_BOUNDARY(name) #name,
    return std::to_array<std::string_view>({
        "periodic",
        "no_slip",
        "free_slip",
        "velocity_inlet",
        "pressure_outlet",
#include "fluid_lbm/effects.inc"
    });
#undef MAGFSI_BOUNDARY
#undef MAGFSI_EFFECT
}

// Profile of an inlet's velocity over its opening. s is the distance from the middle over
// half the width (over the radius of a disc); rectangles take the product over both axes.
// Along an axis that is periodic or has free slip at an end, the profile does not fall
// off at that end.
enum class InletProfile {
    uniform,
    parabolic,  // 1 - s^2
    plug,       // 1 - s^8: flat, falling to zero over the outer fifth
};
constexpr auto words_of(InletProfile) {
    return std::to_array<std::string_view>({"uniform", "parabolic", "plug"});
}

// Courses of an inlet's velocity: a factor over time.
struct InletWave {  // mean + amplitude sin(2 pi f t + phase)
    double mean = 1, amplitude = 0, frequency_hz = 0, phase_rad = 0;
};
// Factors linear between rows and constant before the first and after the last one;
// repeat: the table starts again after its last row.
struct InletTable {
    std::vector<double> time_s, factor;
    bool repeat = false;
    std::string file;    // CSV file to read the rows from, relative to the scene
    std::string source;  // file that the rows have been read from
};
// A formula of t: as written, with units, and converted to numbers in SI.
struct InletFormula {
    std::string written, si;
};
using InletCourse = std::variant<InletWave, InletTable, InletFormula>;

// Velocity of an inlet over its opening and over time.
struct Inlet {
    Vec3 velocity_m_s{};  // mean over the opening, whatever the profile and the grid
    InletProfile profile = InletProfile::uniform;
    double ramp_s = 0;  // start from rest by the factor (1 - cos(pi t / ramp_s)) / 2
    std::optional<InletCourse> course{};
    // The course as the solver uses it: the factor at a time [s], an empty function
    // without a course, and the largest magnitude of the factor.
    std::function<double(double)> factor{};
    double peak_factor = 1;
};

// Openings of a side, in its plane: coordinates along the two other axes in the order x,
// y, z, from the box's lowest corner. A cell at an inlet takes part with the share of its
// face that lies in the opening; a cell at an outlet takes part if its face's centre
// does.
struct Rectangle {
    std::array<double, 2> centre_m{}, size_m{};
    double area_m2() const { return size_m[0] * size_m[1]; }
};
struct Disc {
    std::array<double, 2> centre_m{};
    double diameter_m = 0;
    double area_m2() const { return std::numbers::pi * diameter_m * diameter_m / 4; }
};
using Patch = std::variant<Rectangle, Disc>;
inline double area_m2(const Patch& patch) {
    return std::visit([](const auto& shape) { return shape.area_m2(); }, patch);
}

// One side of the box.
struct Boundary {
    BoundaryKind kind = BoundaryKind::periodic;
    Vec3 wall_velocity_m_s{};       // no_slip only; tangential to the side
    Inlet inlet{};                  // velocity_inlet only
    double outlet_pressure_pa = 0;  // pressure_outlet only; gauge pressure
    // Open part of a side with an inlet or an outlet; the rest is a wall at rest. Absent:
    // the whole side is open.
    std::optional<Patch> patch{};
};

// The side's opening if it has this shape, else null.
template <class Shape>
const Shape* opening(const Boundary& side) {
    return side.patch ? std::get_if<Shape>(&*side.patch) : nullptr;
}

// --- obstacles: bodies at rest in the fluid -----------------------------------------

// A rigid body at rest.
struct Obstacle {
    std::string name;  // in error messages and probes
    ObstacleShape shape;
};

// --- the fluid ----------------------------------------------------------------------

// All options of the fluid.
struct Options {
    double density_kg_m3 = 0;
    double viscosity_m2_s = 0;  // kinematic viscosity at rest
    // Kinematic bulk viscosity; absent: what the collision has, 2/3 of the viscosity.
    std::optional<double> bulk_viscosity_m2_s;
    Collision collision = Collision::automatic;
    // Magic number Lambda of the collisions trt and recursive_mrt; absent: chosen by
    // collision/choice.h.
    std::optional<double> magic_number;
    Precision precision = Precision::double_;
    double smagorinsky_constant = 0;       // constant C of the eddy viscosity; 0: none
    std::optional<Rheology> rheology;      // absent: constant viscosity
    std::array<Boundary, 6> boundaries{};  // x_min x_max y_min y_max z_min z_max
    std::vector<Obstacle> obstacles;
    std::optional<Vec3> body_force_n_m3;
};

}  // namespace magfsi::fluid
