#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/checks.h"
#include "adapters/scene/names.h"
#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

constexpr double divides_within = 1e-6;  // of a side: far below what a cell resolves
constexpr int least_cells = 4;       // the widest delta kernel spans 4 cells; it wraps
constexpr double most_cells = 1e11;  // 8 TB of populations in single precision
constexpr double most_cells_along = 2e9;  // their number is an int

bool divides(double side, double spacing) {
    const double cells = std::round(side / spacing);
    return cells >= 1 && std::abs(cells * spacing / side - 1) <= divides_within;
}

bool divides_all(const Vec3& box, double spacing) {
    return std::ranges::all_of(box, [=](double side) { return divides(side, spacing); });
}

// The spacing nearest to the wanted one that divides all sides, or the box of whole
// cells. It divides the shortest side, too, which has the fewest cells to look at.
std::string advice(const Fluid& fluid) {
    const double wanted = fluid.spacing_m;
    const double shortest = std::ranges::min(fluid.box_m);
    const long cells = std::max(1L, std::lround(shortest / wanted));
    for (long away = 0; 2 * away <= cells; ++away) {
        double best = 0;
        for (const long n : {cells - away, cells + away}) {
            const double spacing = shortest / static_cast<double>(n);
            if (divides_all(fluid.box_m, spacing) &&
                (best == 0 || std::abs(spacing - wanted) < std::abs(best - wanted)))
                best = spacing;
        }
        // Digits enough to pass divides_within when typed in again.
        if (best > 0) return fmt::format("the nearest is {:.9g} mm", 1e3 * best);
    }
    Vec3 box{};
    for (int i = 0; i < 3; ++i)
        box[i] = std::max(1.0, std::round(fluid.box_m[i] / wanted)) * wanted;
    return fmt::format("the nearest box is [{}, {}, {}]", format_si(box[0], "m"),
                       format_si(box[1], "m"), format_si(box[2], "m"));
}

// A slip of a unit, most often, and more than any machine holds.
void check_cells(const Fluid& fluid, const Marks& marks) {
    double all = 1, along = 0;
    for (const double side : fluid.box_m) {
        const double cells = std::max(1.0, side / fluid.spacing_m);
        all *= cells;
        along = std::max(along, cells);
    }
    if (all <= most_cells && along <= most_cells_along) return;
    const double coarser =
        std::max(std::cbrt(all / most_cells), along / most_cells_along);
    refuse(marks.value({"fluid", "spacing"}),
           fmt::format("{:.3g} cells, {:.3g} along the longest side", all, along),
           fmt::format("at most {:.0e} cells, {:.0e} along a side", most_cells,
                       most_cells_along),
           fmt::format("take a spacing above {}, or a smaller box",
                       format_si(coarser * fluid.spacing_m, "m")));
}

void check_spacing(const Fluid& fluid, const Marks& marks) {
    for (int i = 0; i < 3; ++i) {
        const bool periodic = fluid.boundaries[2 * i].kind == BoundaryKind::periodic;
        if (!periodic &&
            fluid.box_m[i] / fluid.spacing_m < least_cells * (1 - divides_within))
            refuse(marks.value({"fluid", "spacing"}),
                   fmt::format("{:.3g} cells along {}", fluid.box_m[i] / fluid.spacing_m,
                               axis_names[i]),
                   fmt::format("at least {} cells between walls", least_cells),
                   fmt::format("take a spacing of at most {}",
                               format_si(fluid.box_m[i] / least_cells, "m")));
        if (!divides(fluid.box_m[i], fluid.spacing_m))
            refuse(
                marks.value({"fluid", "spacing"}),
                fmt::format("the spacing {}, which does not divide the box's {} along {}",
                            format_si(fluid.spacing_m, "m"),
                            format_si(fluid.box_m[i], "m"), axis_names[i]),
                "a spacing that divides every side", advice(fluid));
    }
}

void check_periodic_pairs(const Fluid& fluid, const Marks& marks) {
    for (std::size_t low = 0; low < 6; low += 2) {
        const bool a = fluid.boundaries[low].kind == BoundaryKind::periodic;
        const bool b = fluid.boundaries[low + 1].kind == BoundaryKind::periodic;
        if (a == b) continue;
        const std::string periodic(names<Face>[a ? low : low + 1]);
        const std::string other(names<Face>[a ? low + 1 : low]);
        refuse(marks.value({"fluid", "boundaries", periodic}),
               fmt::format("{} periodic but {} not", periodic, other),
               "periodic in pairs", fmt::format("make {} periodic as well", other));
    }
}

void check_walls(const Fluid& fluid, const Marks& marks) {
    for (std::size_t face = 0; face < 6; ++face) {
        if (fluid.boundaries[face].kind != BoundaryKind::no_slip) continue;
        const double normal = fluid.boundaries[face].wall_velocity_m_s[face / 2];
        if (normal == 0) continue;
        const std::string name(names<Face>[face]);
        refuse(marks.value({"fluid", "boundaries", name, "no_slip", "velocity"}),
               fmt::format("the wall {} moving along its normal at {:.6g} m/s", name,
                           normal),
               "velocities along the wall",
               fmt::format("set the {} component to 0 m/s", axis_names[face / 2]));
    }
}

void check_inlets(const Fluid& fluid, const Marks& marks) {
    for (std::size_t face = 0; face < 6; ++face) {
        const Boundary& side = fluid.boundaries[face];
        if (side.kind != BoundaryKind::velocity_inlet ||
            side.inlet.velocity_m_s != Vec3{})
            continue;
        const std::string name(names<Face>[face]);
        refuse(marks.value({"fluid", "boundaries", name}),
               fmt::format("the inlet {} without a velocity", name),
               "velocity_inlet: {velocity: [x, y, z]}, not zero");
    }
}

void check_taylor_green(const Fluid& fluid, const Marks& marks) {
    const Origin& where = marks.key({"fluid", "taylor_green"});
    if (fluid.initial_velocity_m_s) {
        refuse(where, "the Taylor-Green vortex and an initial velocity", "one of the two",
               "leave initial_velocity out");
    }
    const auto periodic = [](const Boundary& side) {
        return side.kind == BoundaryKind::periodic;
    };
    const Vec3& box = fluid.box_m;
    if (std::ranges::all_of(fluid.boundaries, periodic) && box[0] == box[1] &&
        box[0] == box[2])
        return;
    refuse(where, "the Taylor-Green vortex in a box that is no periodic cube",
           "a cube whose six boundaries are periodic");
}

}  // namespace

void check_fluid(const Scene& scene, const Marks& marks) {
    if (!scene.fluid) return;
    check_cells(*scene.fluid, marks);
    check_spacing(*scene.fluid, marks);
    check_periodic_pairs(*scene.fluid, marks);
    check_walls(*scene.fluid, marks);
    check_inlets(*scene.fluid, marks);
    if (scene.fluid->taylor_green) check_taylor_green(*scene.fluid, marks);
}

}  // namespace magfsi::scene
