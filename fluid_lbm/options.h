// SPDX-License-Identifier: GPL-2.0-or-later
// What users choose of the fluid: collision, precision, the sides of the box, obstacles.
// SI, coordinates from the box's lowest corner. The scene file describes these types
// themselves (adapters/scene/keys_fluid.cpp). The words of an enumeration stand beside
// it, in its order.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fluid_lbm/obstacle/shapes.h"
#include "fluid_lbm/rheology.h"
#include "words/name_of.h"

namespace magfsi::fluid {

// streaming/kernels.cpp says which kernel each one is.
enum class Collision { automatic, bgk, trt, recursive_regularized, recursive_mrt };
constexpr auto words_of(Collision) {
    return std::to_array<std::string_view>(
        {"automatic", "bgk", "trt", "recursive_regularized", "recursive_mrt"});
}

// What populations are stored as, and computed with. float halves memory and time;
// float_double costs little more than float and leaves only the rounding of storage.
enum class Precision { double_, float_, float_double };
constexpr auto words_of(Precision) {
    return std::to_array<std::string_view>({"double", "float", "float_double"});
}

// --- sides of the box ---------------------------------------------------------------

enum class BoundaryKind {
    periodic,         // with the opposite side
    no_slip,          // at rest, or moving along itself with wall_velocity_m_s
    free_slip,        // no flow through, no shear: a plane of symmetry
    velocity_inlet,   // prescribed velocity, in or out
    pressure_outlet,  // lets flow and sound out
// And those of which only their effect knows.
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

// How an inlet's velocity varies over its opening. Along an axis that is periodic or has
// free slip at an end it does not fall there. With s the distance from the middle over
// half the width (radius of a disc), rectangles take the product over both axes:
enum class InletProfile {
    uniform,
    parabolic,  // 1 - s^2
    plug,       // 1 - s^8: flat, falling to zero over the outer fifth
};
constexpr auto words_of(InletProfile) {
    return std::to_array<std::string_view>({"uniform", "parabolic", "plug"});
}

// Factors of an inlet's velocity over time.
struct InletWave {  // mean + amplitude sin(2 pi f t + phase)
    double mean = 1, amplitude = 0, frequency_hz = 0, phase_rad = 0;
};
struct InletTable {  // linear between rows, held before and after
    std::vector<double> time_s, factor;
    bool repeat = false;
    std::string file;    // CSV that the rows are in, instead
    std::string source;  // the file that they have been read from
};
struct InletFormula {  // with units, and in numbers of SI
    std::string written, si;
};
using InletCourse = std::variant<InletWave, InletTable, InletFormula>;

struct Inlet {
    Vec3 velocity_m_s{};  // mean over the opening, whatever the profile and the grid
    InletProfile profile = InletProfile::uniform;
    double ramp_s = 0;  // grows from rest as (1 - cos(pi t / ramp)) / 2
    std::optional<InletCourse> course{};
    // What the course comes to, for the fluid: factor at a time [s], none where there is
    // no course, and the largest size of it.
    std::function<double(double)> factor{};
    double peak_factor = 1;
};

// Openings of a side, in its plane: coordinates along the two other axes in the order x,
// y, z, from the box's lowest corner. Of an inlet a cell has the share of its face that
// belongs; to an outlet it belongs if the centre of its face does.
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

// The side's opening if it is of that shape, else null.
template <class Shape>
const Shape* opening(const Boundary& side) {
    return side.patch ? std::get_if<Shape>(&*side.patch) : nullptr;
}

// --- obstacles: bodies at rest in the fluid -----------------------------------------

struct Obstacle {
    std::string name;  // for errors and probes
    ObstacleShape shape;
};

// --- the fluid ----------------------------------------------------------------------

struct Options {
    double density_kg_m3 = 0;
    double viscosity_m2_s = 0;  // kinematic
    Collision collision = Collision::automatic;
    // Lambda of two-relaxation-time collision; absent: by relaxation time.
    std::optional<double> magic_number;
    Precision precision = Precision::double_;
    double smagorinsky_constant = 0;       // of the eddy viscosity; 0: none
    std::optional<Rheology> rheology;      // absent: the viscosity is constant
    std::array<Boundary, 6> boundaries{};  // x_min x_max y_min y_max z_min z_max
    std::vector<Obstacle> obstacles;
    std::optional<Vec3> body_force_n_m3;
};

}  // namespace magfsi::fluid
