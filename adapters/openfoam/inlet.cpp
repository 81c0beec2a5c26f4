#include "adapters/openfoam/inlet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace magfsi::openfoam {

namespace {

double falloff(fluid::InletProfile profile, double s) {
    if (profile == fluid::InletProfile::uniform) return 1;
    return std::max(0.0,
                    1 - std::pow(s, profile == fluid::InletProfile::parabolic ? 2 : 8));
}

// Over a whole side, along one axis of it; a plane of symmetry at one end doubles the
// width.
double between_sides(const scene::Fluid& fluid, fluid::InletProfile profile,
                     std::size_t axis, double at_m) {
    const auto is_wall = [&](std::size_t side) {
        return fluid.boundaries[side].kind == fluid::BoundaryKind::no_slip;
    };
    const bool low = is_wall(2 * axis), high = is_wall(2 * axis + 1);
    const double s = at_m / fluid.box_m[axis];
    if (!low && !high) return 1;
    if (low && high) return falloff(profile, std::abs(2 * s - 1));
    return falloff(profile, low ? 1 - s : s);
}

double shape_at(const scene::Fluid& fluid, const fluid::Boundary& side,
                const std::array<std::size_t, 2>& axes,
                const std::array<double, 2>& at_m) {
    double shape = 1;
    if (const auto* disc = fluid::opening<fluid::Disc>(side)) {
        const double s =
            2 * std::hypot(at_m[0] - disc->centre_m[0], at_m[1] - disc->centre_m[1]) /
            disc->diameter_m;
        return s > 1 ? 0 : falloff(side.inlet.profile, s);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        if (const auto* part = fluid::opening<fluid::Rectangle>(side)) {
            const double s = 2 * std::abs(at_m[i] - part->centre_m[i]) / part->size_m[i];
            shape *= s > 1 ? 0 : falloff(side.inlet.profile, s);
        } else {
            shape *= between_sides(fluid, side.inlet.profile, axes[i], at_m[i]);
        }
    }
    return shape;
}

bool is_open(const fluid::Boundary& side, const std::array<double, 2>& at_m) {
    if (const auto* disc = fluid::opening<fluid::Disc>(side)) {
        return 2 * std::hypot(at_m[0] - disc->centre_m[0], at_m[1] - disc->centre_m[1]) <=
               disc->diameter_m;
    }
    const auto* part = fluid::opening<fluid::Rectangle>(side);
    for (std::size_t i = 0; part && i < 2; ++i) {
        if (2 * std::abs(at_m[i] - part->centre_m[i]) > part->size_m[i]) return false;
    }
    return true;
}

// What brings the mean over the opening to 1, and the shape by face of this rank's part.
struct Shape {
    double factor = 0;
    std::vector<double> here;
};

Shape shape_of(const scene::Fluid& fluid, const BoxMesh& mesh, int side) {
    const auto normal = static_cast<std::size_t>(side / 2);
    const std::array<std::size_t, 2> axes{normal == 0 ? 1u : 0u, normal == 2 ? 1u : 2u};
    const auto is_here = [&](std::size_t axis, std::size_t cell) {
        if (axis != static_cast<std::size_t>(mesh.cut_axis)) return true;
        const auto i = static_cast<int>(cell);
        const auto rank = static_cast<std::size_t>(mesh.rank);
        return i >= mesh.first_cell[rank] && i < mesh.first_cell[rank + 1];
    };
    const fluid::Boundary& inlet = fluid.boundaries[static_cast<std::size_t>(side)];
    const auto& a = mesh.planes_m[axes[0]];
    const auto& b = mesh.planes_m[axes[1]];
    Shape shape;
    double flux = 0, open_area = 0;
    for (std::size_t j = 0; j + 1 < b.size(); ++j) {
        for (std::size_t i = 0; i + 1 < a.size(); ++i) {
            const std::array<double, 2> at{(a[i] + a[i + 1]) / 2, (b[j] + b[j + 1]) / 2};
            const double area = (a[i + 1] - a[i]) * (b[j + 1] - b[j]);
            const double s = shape_at(fluid, inlet, axes, at);
            if (is_here(axes[0], i) && is_here(axes[1], j)) shape.here.push_back(s);
            flux += s * area;
            if (is_open(inlet, at)) open_area += area;
        }
    }
    if (flux > 0) shape.factor = open_area / flux;
    return shape;
}

}  // namespace

double inlet_factor(const scene::Fluid& fluid, const BoxMesh& mesh, int side) {
    return shape_of(fluid, mesh, side).factor;
}

std::vector<double> slab_shape(const scene::Fluid& fluid, const BoxMesh& mesh, int side) {
    Shape shape = shape_of(fluid, mesh, side);
    for (double& s : shape.here) s *= shape.factor;
    return std::move(shape.here);
}

double inlet_ramp(const fluid::Boundary& side, double time_s) {
    if (time_s >= side.inlet.ramp_s) return 1;
    return (1 - std::cos(std::numbers::pi * time_s / side.inlet.ramp_s)) / 2;
}

namespace {

using Axes = std::array<std::size_t, 2>;

std::string falloff_of(fluid::InletProfile profile, const std::string& s) {
    if (profile == fluid::InletProfile::uniform) return "1";
    return fmt::format("max(0, 1 - pow({}, {}))", s,
                       profile == fluid::InletProfile::parabolic ? 2 : 8);
}

std::string coordinate(std::size_t axis) {
    return fmt::format("pos().{}()", "xyz"[axis]);
}

// As between_sides.
std::string between(const scene::Fluid& fluid, fluid::InletProfile profile,
                    std::size_t axis) {
    const auto is_wall = [&](std::size_t side) {
        return fluid.boundaries[side].kind == fluid::BoundaryKind::no_slip;
    };
    const bool low = is_wall(2 * axis), high = is_wall(2 * axis + 1);
    const std::string s =
        fmt::format("({}/{:.17g})", coordinate(axis), fluid.box_m[axis]);
    if (!low && !high) return "1";
    if (low && high) return falloff_of(profile, fmt::format("mag(2*{} - 1)", s));
    return falloff_of(profile, low ? fmt::format("(1 - {})", s) : s);
}

// As shape_at.
std::string shape_text(const scene::Fluid& fluid, const fluid::Boundary& side,
                       const Axes& axes) {
    const auto part = [&](const std::string& s) {
        return fmt::format("({} > 1 ? 0 : {})", s, falloff_of(side.inlet.profile, s));
    };
    if (const auto* disc = fluid::opening<fluid::Disc>(side)) {
        return part(fmt::format("(2*sqrt(sqr({} - {:.17g}) + sqr({} - {:.17g}))/{:.17g})",
                                coordinate(axes[0]), disc->centre_m[0],
                                coordinate(axes[1]), disc->centre_m[1],
                                disc->diameter_m));
    }
    std::string text = "1";
    for (std::size_t i = 0; i < 2; ++i) {
        if (const auto* r = fluid::opening<fluid::Rectangle>(side)) {
            text += fmt::format("*{}", part(fmt::format("(2*mag({} - {:.17g})/{:.17g})",
                                                        coordinate(axes[i]),
                                                        r->centre_m[i], r->size_m[i])));
        } else {
            text += fmt::format("*{}", between(fluid, side.inlet.profile, axes[i]));
        }
    }
    return text;
}

}  // namespace

std::string inlet_condition(const scene::Fluid& fluid, const BoxMesh& mesh, int side) {
    const fluid::Boundary& inlet = fluid.boundaries[static_cast<std::size_t>(side)];
    const auto normal = static_cast<std::size_t>(side / 2);
    const Axes axes{normal == 0 ? 1u : 0u, normal == 2 ? 1u : 2u};
    std::string ramp = "1";
    if (inlet.inlet.ramp_s > 0)
        ramp = fmt::format("(time() >= {0:.17g} ? 1 : (1 - cos(pi()*time()/{0:.17g}))/2)",
                           inlet.inlet.ramp_s);
    const auto& u = inlet.inlet.velocity_m_s;
    return fmt::format(
        "type exprFixedValue; value uniform (0 0 0);\n        valueExpr "
        "\"{:.17g}*{}*({})*vector({:.17g}, {:.17g}, {:.17g})\";",
        inlet_factor(fluid, mesh, side), ramp, shape_text(fluid, inlet, axes), u[0], u[1],
        u[2]);
}

}  // namespace magfsi::openfoam
