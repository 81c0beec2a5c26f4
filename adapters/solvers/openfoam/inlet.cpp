// SPDX-License-Identifier: GPL-2.0-or-later
// Inlet profiles, once as numbers for the engine and once as expressions for stock
// programs, from the same templates.
#include "adapters/solvers/openfoam/inlet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace magfsi::openfoam {

namespace {

using Axes = std::array<std::size_t, 2>;

// The two axes of a side's plane, in ascending order.
Axes plane_axes(int side) {
    return {side / 2 == 0 ? 1u : 0u, side / 2 == 2 ? 1u : 2u};
}

// An expression in OpenFOAM's language. The profile below is a template over the number
// type: with double it gives a value, with Formula the text of its formula, so that it is
// written only once.
struct Formula {
    std::string text;

    explicit Formula(std::string formula) : text(std::move(formula)) {}
    Formula(double value) : text(fmt::format("{:.17g}", value)) {}
};

Formula operator-(const Formula& a, const Formula& b) {
    return Formula(fmt::format("({} - {})", a.text, b.text));
}
Formula operator*(const Formula& a, const Formula& b) {
    return Formula(fmt::format("{}*{}", a.text, b.text));
}
Formula operator/(const Formula& a, const Formula& b) {
    return Formula(fmt::format("({}/{})", a.text, b.text));
}
Formula abs(const Formula& a) {
    return Formula(fmt::format("mag({})", a.text));
}
Formula hypot(const Formula& a, const Formula& b) {
    return Formula(fmt::format("sqrt(sqr({}) + sqr({}))", a.text, b.text));
}

// max(0, 1 - s^exponent), and a value that is 0 for s > 1: as numbers and as formulas.
double one_minus_power(double s, int exponent) {
    return std::max(0.0, 1 - std::pow(s, exponent));
}
Formula one_minus_power(const Formula& s, int exponent) {
    return Formula(fmt::format("max(0, 1 - pow({}, {}))", s.text, exponent));
}
double zero_beyond_one(double s, double value) {
    return s > 1 ? 0 : value;
}
Formula zero_beyond_one(const Formula& s, const Formula& value) {
    return Formula(fmt::format("({} > 1 ? 0 : {})", s.text, value.text));
}

// Profile over the distance s from the middle, with s = 1 at the wall: uniform (1),
// parabolic (1 - s^2), or blunt (1 - s^8).
template <class T>
T falloff(fluid::InletProfile profile, const T& s) {
    if (profile == fluid::InletProfile::uniform) return 1.0;
    return one_minus_power(s, profile == fluid::InletProfile::parabolic ? 2 : 8);
}

// Profile along one axis of an inlet that spans a whole side. Walls at both ends make it
// symmetric; with a wall at one end only, the other end is the middle of the profile (as
// at a plane of symmetry).
template <class T>
T between_sides(const scene::Fluid& fluid, fluid::InletProfile profile, std::size_t axis,
                const T& at_m) {
    const auto is_wall = [&](std::size_t side) {
        return fluid.boundaries[side].kind == fluid::BoundaryKind::no_slip;
    };
    const bool low = is_wall(2 * axis), high = is_wall(2 * axis + 1);
    const T s = at_m / fluid.box_m[axis];
    using std::abs;
    if (!low && !high) return 1.0;
    if (low && high) return falloff<T>(profile, abs(2.0 * s - 1.0));
    return falloff<T>(profile, low ? 1.0 - s : s);
}

// Distances from the middle of an opening, over its half widths: one for a disc, two for
// a rectangle, none for a whole side. They are 1 at the rim.
template <class T>
std::vector<T> in_opening(const fluid::Boundary& side, const std::array<T, 2>& at_m) {
    using std::abs, std::hypot;
    if (const auto* disc = fluid::opening<fluid::Disc>(side)) {
        return {2.0 * hypot(at_m[0] - disc->centre_m[0], at_m[1] - disc->centre_m[1]) /
                disc->diameter_m};
    }
    std::vector<T> all;
    const auto* part = fluid::opening<fluid::Rectangle>(side);
    for (std::size_t i = 0; part && i < 2; ++i)
        all.push_back(2.0 * abs(at_m[i] - part->centre_m[i]) / part->size_m[i]);
    return all;
}

// Profile at a point of the side, not yet scaled to a mean of 1. A side without an
// opening takes the product of the profiles along its two axes.
template <class T>
T shape_at(const scene::Fluid& fluid, const fluid::Boundary& side, const Axes& axes,
           const std::array<T, 2>& at_m) {
    const auto profile = side.inlet.profile;
    T shape = 1.0;
    if (!side.patch) {
        for (std::size_t i = 0; i < 2; ++i)
            shape = shape * between_sides<T>(fluid, profile, axes[i], at_m[i]);
    }
    for (const T& s : in_opening<T>(side, at_m))
        shape = shape * zero_beyond_one(s, falloff<T>(profile, s));
    return shape;
}

// Profile of this rank's faces, and the factor that makes the mean over the opening 1.
struct Shape {
    double factor = 0;
    std::vector<double> here;
};

// Sums over the faces of the whole side, so that all ranks get the same factor. The
// opening's exact area counts, not that of the faces whose centres lie in it.
Shape shape_of(const scene::Fluid& fluid, const BoxMesh& mesh, int side) {
    const Axes axes = plane_axes(side);
    const auto is_here = [&](std::size_t axis, std::size_t cell) {
        if (axis != static_cast<std::size_t>(mesh.cut_axis)) return true;
        const int i = cell;
        const std::size_t rank = mesh.rank;
        return i >= mesh.first_cell[rank] && i < mesh.first_cell[rank + 1];
    };
    const fluid::Boundary& inlet = fluid.boundaries[side];
    const auto& a = mesh.planes_m[axes[0]];
    const auto& b = mesh.planes_m[axes[1]];
    Shape shape;
    double flux = 0, open_area = 0;
    for (std::size_t j = 0; j + 1 < b.size(); ++j) {
        for (std::size_t i = 0; i + 1 < a.size(); ++i) {
            const std::array<double, 2> at{(a[i] + a[i + 1]) / 2, (b[j] + b[j + 1]) / 2};
            const double area = (a[i + 1] - a[i]) * (b[j + 1] - b[j]);
            const auto s = shape_at<double>(fluid, inlet, axes, at);
            if (is_here(axes[0], i) && is_here(axes[1], j)) shape.here.push_back(s);
            flux += s * area;
            open_area += area;
        }
    }
    if (inlet.patch) open_area = fluid::area_m2(*inlet.patch);
    if (!(flux > 0)) {
        throw std::invalid_argument(fmt::format(
            "fluid.boundaries.{}: found an opening that holds the centre of no cell's "
            "face; make it larger, or fluid.spacing finer",
            fluid::side_name[side]));
    }
    shape.factor = open_area / flux;
    return shape;
}

}  // namespace

// The factor is the same on all ranks.
std::vector<double> slab_shape(const scene::Fluid& fluid, const BoxMesh& mesh, int side) {
    Shape shape = shape_of(fluid, mesh, side);
    for (double& s : shape.here) s *= shape.factor;
    return std::move(shape.here);
}

std::vector<double> shape_at_faces(const scene::Fluid& fluid, const BoxMesh& mesh,
                                   int side,
                                   const std::vector<std::array<double, 3>>& centres_m) {
    const Axes axes = plane_axes(side);
    const double factor = shape_of(fluid, mesh, side).factor;
    std::vector<double> shape;
    for (const auto& at : centres_m)
        shape.push_back(factor * shape_at<double>(fluid, fluid.boundaries[side], axes,
                                                  {at[axes[0]], at[axes[1]]}));
    return shape;
}

// The factor is 1 from the start if there is no ramp (ramp_s = 0).
double inlet_ramp(const fluid::Boundary& side, double time_s) {
    if (time_s >= side.inlet.ramp_s) return 1;
    return (1 - std::cos(std::numbers::pi * time_s / side.inlet.ramp_s)) / 2;
}

// exprFixedValue evaluates the text for each face and step; the mean of 1 comes from the
// factor in front.
std::string inlet_condition(const scene::Fluid& fluid, const BoxMesh& mesh, int side) {
    const fluid::Boundary& inlet = fluid.boundaries[side];
    const auto coordinate = [axes = plane_axes(side)](std::size_t i) {
        return Formula(fmt::format("pos().{}()", "xyz"[axes[i]]));
    };
    const Formula shape =
        shape_at<Formula>(fluid, inlet, plane_axes(side), {coordinate(0), coordinate(1)});
    std::string ramp = "1";
    if (inlet.inlet.ramp_s > 0)
        ramp = fmt::format("(time() >= {0:.17g} ? 1 : (1 - cos(pi()*time()/{0:.17g}))/2)",
                           inlet.inlet.ramp_s);
    const auto& u = inlet.inlet.velocity_m_s;
    return fmt::format(
        "type exprFixedValue; value uniform (0 0 0);\n        valueExpr "
        "\"{:.17g}*{}*({})*vector({:.17g}, {:.17g}, {:.17g})\";",
        shape_of(fluid, mesh, side).factor, ramp, shape.text, u[0], u[1], u[2]);
}

}  // namespace magfsi::openfoam
