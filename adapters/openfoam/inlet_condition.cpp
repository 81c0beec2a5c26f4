// An inlet as a boundary condition of OpenFOAM's, for runs without the adapter.
#include <fmt/format.h>

#include "adapters/openfoam/inlet.h"

namespace magfsi::openfoam {

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
