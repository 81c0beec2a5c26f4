// SPDX-License-Identifier: GPL-2.0-or-later
// One function for each kind of file. All of them print the range of what was read, in
// which a wrong unit (mm for m, mT for T) shows.
#include "adapters/app/explain_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "adapters/scene/quantity.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "fluid_lbm/obstacle/solid.h"
#include "structure/lammps/placement.h"
#include "structure/magnetics/grid_field.h"
#include "structure/magnetics/magnetization.h"

namespace magfsi::launch {
namespace {

using scene::format_si;
using structure::Bounds;

// One line of the text.
std::string line(const std::string& file, const std::string& what) {
    return fmt::format("  {}: {}\n", file, what);
}

// "x 0 mm to 5 mm, y ...".
std::string in_words(const Bounds& bounds) {
    std::string text;
    for (std::size_t d = 0; d < 3; ++d)
        text += fmt::format("{}{} {} to {}", d > 0 ? ", " : "", "xyz"[d],
                            format_si(bounds.low_m[d], "m"),
                            format_si(bounds.high_m[d], "m"));
    return text;
}

// Smallest and largest length of the vectors, with unit: "0 T to 12 mT".
std::string range(std::span<const Vec3> vectors, const char* unit) {
    double least = INFINITY, most = 0;
    for (const Vec3& v : vectors) {
        const double length = norm(v);
        least = std::min(least, length);
        most = std::max(most, length);
    }
    return fmt::format("{} to {}", format_si(least, unit), format_si(most, unit));
}

// Longest edge of a bounding box [m].
double longest_m(const Bounds& bounds) {
    return std::ranges::max(bounds.extent_m());
}

// Bounding box [m] of the body at its initial place, not bent.
Bounds placed_bounds(const scene::Body& body, const structure::Body& solid) {
    structure::Placement placement = body.initial;
    placement.relaxed.reset();
    return structure::bounds(structure::placed_nodes(solid, placement, {0, 2}));
}

// Warns if a source's grid is far larger or smaller than the body, a sign of a wrong unit
// (a grid read in metres instead of millimetres would hold the body within one cell), or
// if the body starts outside the grid of a source at rest.
std::string compare(const Bounds& grid, const structure::FieldSource& source,
                    const scene::Body& body, const structure::Body& solid) {
    constexpr double larger = 300;
    const Bounds at = placed_bounds(body, solid);
    const double ratio = longest_m(grid) / longest_m(at);
    if (ratio > larger || ratio < 1 / larger)
        return fmt::format(
            "  warning: the grid of the source '{}' is {:.3g} times as long as body "
            "'{}'; see that its lengths are in the right unit\n",
            source.name, ratio, body.name);
    const bool still = !source.motion && !source.turning && !source.rotation;
    for (std::size_t d = 0; still && d < 3; ++d) {
        const double low = grid.low_m[d] + source.position_m[d];
        const double high = grid.high_m[d] + source.position_m[d];
        if (at.low_m[d] < low || at.high_m[d] > high)
            return fmt::format(
                "  warning: body '{}', {}, lies outside of the grid of the source '{}', "
                "which is there from {} to {} along {}: move it, or take a larger grid\n",
                body.name, in_words(at), source.name, format_si(low, "m"),
                format_si(high, "m"), "xyz"[d]);
    }
    return {};
}

// Points, extent, mean spacing and magnitudes of a grid, with a warning for each body
// that does not fit it.
std::string explain_grid(const scene::Scene& scene, const bodies::Solids& solids,
                         const structure::FieldSource& source) {
    const std::string& file = std::get<structure::GridField>(source.shape).file;
    const structure::GridValues grid = structure::read_grid(file);
    Bounds bounds;
    std::string spacings, points;
    for (std::size_t d = 0; d < 3; ++d) {
        const auto& axis = grid.axes_m()[d];
        bounds.low_m[d] = axis.front();
        bounds.high_m[d] = axis.back();
        const char* between = d > 0 ? " x " : "";
        points += fmt::format("{}{}", between, axis.size());
        spacings += between + format_si((axis.back() - axis.front()) /
                                            static_cast<double>(axis.size() - 1),
                                        "m");
    }
    std::string text =
        line(file, fmt::format("field at {} points, {}, spacing {}, |B| {}", points,
                               in_words(bounds), spacings, range(grid.values_t(), "T")));
    for (std::size_t b = 0; b < solids.size(); ++b)
        text += compare(bounds, source, scene.bodies[b], solids[b]);
    return text;
}

// Times and magnitudes of a table of the uniform field that was read from a file.
std::string explain_course(const scene::FieldLaw& law) {
    const auto* table = std::get_if<scene::VectorTable>(&law);
    if (table == nullptr || table->source.empty()) return {};
    return line(
        table->source,
        fmt::format("field at {} times, {} to {}, |B| {}", table->time_s.size(),
                    format_si(table->time_s.front(), "s"),
                    format_si(table->time_s.back(), "s"), range(table->vector_t, "T")));
}

// Times and factors of an inlet's course that was read from a file.
std::string explain_inlet(const fluid::Inlet& inlet) {
    if (!inlet.course) return {};
    const auto* table = std::get_if<fluid::InletTable>(&*inlet.course);
    if (table == nullptr || table->source.empty()) return {};
    const auto [least, most] = std::ranges::minmax(table->factor);
    return line(table->source,
                fmt::format("factor at {} times, {} to {}, {:.4g} to {:.4g}",
                            table->time_s.size(), format_si(table->time_s.front(), "s"),
                            format_si(table->time_s.back(), "s"), least, most));
}

// Triangles, parts, extent and volume of an STL surface.
std::string explain_surface(const fluid::StlSurface& surface) {
    const fluid::StlExtent read = fluid::stl_extent(surface);
    return line(surface.file,
                fmt::format("surface of {} triangles in {} part{}, {}, {:.4g} mm3",
                            read.triangles, read.parts, read.parts > 1 ? "s" : "",
                            in_words({read.bounds_m.low, read.bounds_m.high}),
                            read.volume_m3 * 1e9));
}

// Files of a body: its mesh or surface, and its table of magnetisation.
std::string explain_body(const scene::Body& body, const structure::Mesh& mesh) {
    std::string text;
    if (const auto* gmsh = std::get_if<structure::MeshFile>(&body.mesh))
        text +=
            line(gmsh->file, fmt::format("mesh of {} elements, {}", mesh.elements.size(),
                                         in_words(structure::bounds(mesh.nodes))));
    if (const auto* voxels = std::get_if<structure::VoxelMesh>(&body.mesh))
        text += explain_surface({voxels->file, voxels->unit_m, {}});
    if (!body.magnetization) return text;
    if (const auto* table =
            std::get_if<structure::TableMagnetization>(&*body.magnetization)) {
        const auto read = structure::read_magnetization(table->file);
        text += line(
            table->file,
            fmt::format(
                "magnetization of {} {}{}{}, |M| {}", read.vector_a_m.size(),
                read.point_m.empty() ? "elements" : "points",
                read.point_m.empty() ? "" : ", ",
                read.point_m.empty() ? "" : in_words(structure::bounds(read.point_m)),
                range(read.vector_a_m, "A/m")));
    }
    return text;
}

}  // namespace

std::string explain_files(const scene::Scene& scene, const bodies::Solids& solids) {
    std::string text;
    for (std::size_t b = 0; b < solids.size(); ++b)
        text += explain_body(scene.bodies[b], solids[b].mesh);
    if (scene.magnetic_field) {
        const scene::MagneticField& field = *scene.magnetic_field;
        if (field.uniform) text += explain_course(field.course);
        for (const scene::FieldTerm& term : field.plus) text += explain_course(term.law);
        for (const structure::FieldSource& source : field.sources) {
            if (std::holds_alternative<structure::GridField>(source.shape))
                text += explain_grid(scene, solids, source);
        }
    }
    if (scene.fluid) {
        for (const auto& side : scene.fluid->boundaries)
            text += explain_inlet(side.inlet);
        for (const auto& obstacle : scene.fluid->obstacles) {
            if (const auto* stl = std::get_if<fluid::StlSurface>(&obstacle.shape))
                text += explain_surface(*stl);
        }
    }
    return text.empty() ? text : "\nfiles\n" + text;
}

}  // namespace magfsi::launch
