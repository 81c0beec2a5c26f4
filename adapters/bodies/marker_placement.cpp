// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/bodies/marker_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>

#include "adapters/bodies/filled_cubes.h"
#include "adapters/bodies/marker_surface.h"
#include "adapters/bodies/scene_to_body.h"
#include "adapters/scene/checks.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/sheet.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

namespace {

using structure::Vec3;

// Spacing of the finest grid and of the markers.
struct Spacings {
    double grid_m, marker_m;
};

// Markers of a sheet, in one layer below each face or in one at mid-surface.
std::vector<PlacedMarker> on_sheet(const structure::Mesh& mesh,
                                   const structure::Sheet& sheet, bool both_faces,
                                   const DryFaces& dry,
                                   const coupler::ImmersedBoundary& boundary,
                                   const Spacings& spacing) {
    std::vector<PlacedMarker> markers;
    // share: fraction of the fluid that the layer moves. faces: the surface that it
    // stands for, 1 the top, -1 the bottom, 2 both; their leakage |U . n| has no sign.
    const auto add = [&](const std::vector<structure::SurfacePoint>& points, double share,
                         int faces) {
        for (const auto& p : points) {
            markers.push_back({p.point, share * p.area_m2 * spacing.grid_m});
            const double area_m2 = faces * p.area_m2;
            set_area(
                markers.back(), mesh,
                {area_m2 * p.normal[0], area_m2 * p.normal[1], area_m2 * p.normal[2]});
        }
    };
    if (both_faces) {
        const double depth_m = boundary.retraction * spacing.grid_m;
        for (const auto side : {structure::SheetSide::bottom, structure::SheetSide::top})
            add(structure::points_below_face(mesh, sheet, side, depth_m,
                                             spacing.marker_m),
                0.5, side == structure::SheetSide::top ? 1 : -1);
    } else {
        add(structure::mid_surface_points(mesh, sheet, spacing.marker_m), 1, 2);
    }
    draw_back(markers, mesh, dry.without(structure::rim_of(mesh, sheet)),
              boundary.rim_retraction * spacing.grid_m, spacing.marker_m);
    return markers;
}

// Markers throughout the volume of a body, thinned out towards its wet surface.
std::vector<PlacedMarker> through_volume(const structure::Mesh& mesh, const DryFaces& dry,
                                         const coupler::ImmersedBoundary& boundary,
                                         const Spacings& spacing) {
    std::vector<PlacedMarker> markers;
    for (const auto& p : structure::volume_points(mesh, spacing.marker_m))
        markers.push_back({p.point, p.volume_m3});
    const auto surface = dry.without(structure::boundary_quads(mesh));
    draw_back(markers, mesh, surface, boundary.retraction * spacing.grid_m,
              spacing.marker_m);
    share_surface(markers, mesh, surface, spacing.marker_m);
    return markers;
}

// Length of the longest edge of the elements; for a sheet only of edges along it.
double longest_edge_m(const structure::Mesh& mesh, const structure::Sheet* sheet) {
    double longest = 0;
    const auto measure = [&](int a, int b) {
        longest = std::max(longest, structure::distance_m(mesh.nodes[a], mesh.nodes[b]));
    };
    for (std::size_t e = 0; !sheet && e < mesh.elements.size(); ++e) {
        const structure::Hexahedron& node = mesh.elements[e];
        for (int a = 0; a < 8; ++a) {
            for (const int axis : {1, 2, 4}) measure(node[a], node[a ^ axis]);
        }
    }
    for (std::size_t c = 0; sheet && c < sheet->columns.size(); ++c) {
        for (const auto& level : sheet->columns[c].levels) {
            for (std::size_t a = 0; a < 4; ++a) measure(level[a], level[(a + 1) % 4]);
        }
    }
    return longest;
}

// Shares the body's volume among its markers in proportion to the fluid that they move.
void share_body(std::vector<PlacedMarker>& markers, double body_m3, int number) {
    double sum = 0;
    for (const PlacedMarker& m : markers) sum += m.volume_m3;
    for (PlacedMarker& m : markers) {
        m.displaced_m3 = m.volume_m3 * body_m3 / sum;
        m.body = number;
    }
}

}  // namespace

std::vector<PlacedMarker> place_markers(const scene::Scene& scene, std::size_t number) {
    const scene::Body& body = scene.bodies[number];
    const coupler::ImmersedBoundary& boundary = scene.coupling->immersed_boundary;
    const structure::Continues continues =
        spans_fluid(*scene.fluid, body, boundary.forcing == coupler::Forcing::no_slip);
    const structure::Mesh mesh = to_mesh(body);
    const double grid_m = scene.fluid->finest_spacing_m();
    const Spacings spacing{grid_m, boundary.marker_spacing * grid_m};
    const auto sheet = structure::find_sheet(mesh, continues);
    const bool surface =
        boundary.markers && *boundary.markers != coupler::Markers::volume;
    if (surface && !sheet) {
        throw std::invalid_argument(
            "body '" + body.name +
            "' is no sheet (columns of equally many elements between two large faces): "
            "its markers can only be coupling.immersed_boundary.markers: volume");
    }
    const bool on_surface = surface || (sheet && !boundary.markers);
    if (boundary.forcing != coupler::Forcing::no_slip)
        scene::require_marker_spacing(
            scene, body, longest_edge_m(mesh, on_surface ? &*sheet : nullptr),
            {fmt::format("body '{}'", body.name)});
    const DryFaces dry(body, mesh, continues);
    const bool both_faces = boundary.markers != coupler::Markers::mid_surface;
    auto markers = boundary.forcing == coupler::Forcing::no_slip
                       ? no_slip_markers(body, mesh, dry, reach_in(scene), continues)
                   : on_surface
                       ? on_sheet(mesh, *sheet, both_faces, dry, boundary, spacing)
                       : through_volume(mesh, dry, boundary, spacing);
    const auto* cubes = std::get_if<structure::VoxelMesh>(&body.mesh);
    share_body(markers, cubes ? surface_volume_m3(*cubes) : structure::volume_m3(mesh),
               static_cast<int>(number));
    return markers;
}

structure::Continues spans_fluid(const scene::Fluid& fluid, const scene::Body& body,
                                 bool between_walls) {
    structure::Continues spans{};
    const structure::Mesh mesh = to_mesh(body);
    for (int d = 0; d < 3; ++d)
        spans[d] = scene::spans_fluid(fluid, body, d, extent(mesh, d), between_walls);
    return spans;
}

}  // namespace magfsi::bodies
