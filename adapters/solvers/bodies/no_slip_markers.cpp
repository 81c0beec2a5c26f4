// SPDX-License-Identifier: GPL-2.0-or-later
// Markers of forcing no_slip: even rows about a grid spacing apart, in as many layers as
// have the effective thickness of the body (wall_of_planes.h).
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <variant>

#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/marker_surface.h"
#include "adapters/solvers/bodies/thinned_markers.h"
#include "base/fitted/constants.h"
#include "structure/mesh/block_mesh.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/swept_mesh.h"

namespace magfsi::bodies {

namespace {

// Depth below the rim at which the area of a single layer's markers ends [m]; negative,
// outside of the rim, for thick sheets.
double rim_depth_m(const KernelReach& reach, double thickness_m) {
    return reach.edge_m - fitted::square_edge * thickness_m;
}

// Even rows along one axis of a box: their coordinates and their distance.
struct Rows {
    std::vector<double> at_m;
    double apart_m = 0;
};

// The fewest rows between two ends that are at most widest_m apart; the outer ones lie
// half a distance from the ends.
Rows even_rows(double low_m, double high_m, double widest_m) {
    const int n = std::max<int>(1, std::ceil((high_m - low_m) / widest_m - 1e-9));
    Rows rows{{}, (high_m - low_m) / n};
    for (int i = 0; i < n; ++i) rows.at_m.push_back(low_m + (i + 0.5) * rows.apart_m);
    return rows;
}

// The planes whose wall stands within_m inside of both ends.
Rows layers(double low_m, double high_m, const KernelReach& reach, double within_m = 0) {
    const EvenPlanes planes = reach.layers(high_m - low_m - 2 * within_m);
    const double middle_m = 0.5 * (low_m + high_m);
    Rows rows{{}, planes.apart * reach.grid_m};
    for (int i = 0; i < planes.count; ++i)
        rows.at_m.push_back(middle_m + (i - 0.5 * (planes.count - 1)) * rows.apart_m);
    return rows;
}

// Extent of a block along one of its axes; an end is wet where fluid touches it.
struct Length {
    double low_m, high_m;
    bool low_wet, high_wet;

    double length_m() const { return high_m - low_m; }

    // Rows that keep this distance from wet ends, but at most a quarter of the length.
    Rows drawn_back(double depth_m, double widest_m) const {
        const double drawn_m = std::min(depth_m, 0.25 * length_m());
        return even_rows(low_m + (low_wet ? drawn_m : 0),
                         high_m - (high_wet ? drawn_m : 0), widest_m);
    }
};

// Rows between a dry end, half a distance from it, and a wet one, their wall within_m
// inside of it.
Rows rows_from_dry_end(const Length& length, double within_m, const KernelReach& reach) {
    const double widest_m = fitted::widest_apart * reach.grid_m;
    Rows rows{{}, widest_m};
    std::size_t count = 1;
    double depth_m = 0;
    // The depth depends a little on the distance that follows from it.
    for (int turn = 0; turn < 5; ++turn) {
        depth_m = within_m + reach.depth_m(rows.apart_m);
        const double covered_m =
            std::max(length.length_m() - depth_m, 0.25 * length.length_m());
        count =
            std::max<std::size_t>(count, std::ceil(covered_m / widest_m + 0.5 - 1e-9));
        rows.apart_m = covered_m / (count - 0.5);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double from_dry_m = (i + 0.5) * rows.apart_m;
        rows.at_m.push_back(length.low_wet ? length.high_m - from_dry_m
                                           : length.low_m + from_dry_m);
    }
    return rows;
}

Rows rows_along(const Length& length, const KernelReach& reach, double thickness_m) {
    const double widest_m = fitted::widest_apart * reach.grid_m;
    if (reach.takes_one_layer(thickness_m))
        return length.drawn_back(std::max(0.0, rim_depth_m(reach, thickness_m)),
                                 widest_m);
    const double within_m = fitted::beyond_edge * reach.grid_m;
    if (length.low_wet && length.high_wet)
        return layers(length.low_m, length.high_m, reach, within_m);
    if (length.low_wet || length.high_wet)
        return rows_from_dry_end(length, within_m, reach);
    return even_rows(length.low_m, length.high_m, widest_m);
}

// True if fluid touches the end of a box at this coordinate.
bool wet(std::span<const structure::SurfaceQuad> surface, const structure::Mesh& mesh,
         std::size_t axis, double end_m, double slack_m) {
    return std::ranges::any_of(surface, [&](const structure::SurfaceQuad& quad) {
        return std::ranges::all_of(quad.node, [&](int node) {
            return std::abs(mesh.nodes[node][axis] - end_m) < slack_m;
        });
    });
}

double area_m2(const structure::Mesh& mesh, const structure::Sheet& sheet) {
    double sum_m2 = 0;
    for (const auto& column : sheet.columns)
        sum_m2 += structure::quad_area(structure::corners(mesh.nodes, column.top.node));
    return sum_m2;
}

// A single layer stands for both faces: twice the top, for the vector areas of top and
// bottom would cancel.
constexpr int both = 2;
std::vector<structure::SurfaceQuad> top_of(const structure::Sheet& sheet) {
    std::vector<structure::SurfaceQuad> top;
    for (const auto& column : sheet.columns) top.push_back(column.top);
    return top;
}

// The axes along which a block is thinnest, several of a cube and a square bar; never one
// on which the body goes on, unless it goes on along all.
std::vector<std::size_t> thin_axes(const Vec3& size,
                                   const structure::Continues& continues) {
    const bool endless = std::ranges::count(continues, true) == 3;
    std::vector<std::size_t> thin;
    for (std::size_t d = 0; d < 3; ++d) {
        if (continues[d] && !endless) continue;
        if (!thin.empty() && size[d] < (1 - 1e-9) * size[thin[0]]) thin.clear();
        if (thin.empty() || size[d] < (1 + 1e-9) * size[thin[0]]) thin.push_back(d);
    }
    return thin;
}

// Markers of a block: layers across its thinnest axis and rows along the others; rows
// along all if several are as thin, which keeps its quarter turns. Their surfaces are not
// set here. ring: it is a ring, straightened along x.
std::vector<PlacedMarker> rows_in_block(const structure::Mesh& mesh, const DryFaces& dry,
                                        const KernelReach& reach,
                                        const structure::Continues& continues,
                                        bool ring = false) {
    const structure::Bounds block = structure::bounds(mesh.nodes);
    const Vec3 size = block.extent_m();
    const auto thin = thin_axes(size, continues);
    const auto surface = dry.without(structure::boundary_quads(mesh));
    std::array<Rows, 3> rows;
    for (std::size_t d = 0; d < 3; ++d) {
        const double slack_m = 1e-6 * size[d];
        const double low_m = block.low_m[d], high_m = block.high_m[d];
        rows[d] = thin == std::vector{d}
                      ? layers(low_m, high_m, reach)
                      : rows_along({low_m, high_m, wet(surface, mesh, d, low_m, slack_m),
                                    wet(surface, mesh, d, high_m, slack_m)},
                                   reach, size[thin[0]]);
    }
    if (ring) {
        // Each quarter has as many, so that they keep its mirrors and quarter turns.
        const std::size_t in_quarter = (rows[0].at_m.size() + 3) / 4;
        rows[0] = even_rows(block.low_m[0], block.high_m[0], size[0] / (4 * in_quarter));
    }
    const structure::PointLocator locator(mesh);
    const double volume_m3 = rows[0].apart_m * rows[1].apart_m * rows[2].apart_m;
    std::vector<PlacedMarker> markers;
    for (const double z : rows[2].at_m)
        for (const double y : rows[1].at_m)
            for (const double x : rows[0].at_m)
                markers.push_back({locator.nearest({x, y, z}), volume_m3});
    return markers;
}

// Shares the wet surface among the markers; a single layer stands for both faces.
void share_faces(std::vector<PlacedMarker>& markers, const structure::Mesh& mesh,
                 const std::optional<structure::Sheet>& sheet, bool one_layer,
                 const DryFaces& dry, const KernelReach& reach) {
    if (sheet && one_layer)
        share_surface(markers, mesh, top_of(*sheet), reach.grid_m, both);
    else
        share_surface(markers, mesh, dry.without(structure::boundary_quads(mesh)),
                      reach.grid_m);
}

// Markers of an arc or a helix: those of the straight block, carried by the elements. The
// block of a closed ring continues along x.
std::vector<PlacedMarker> in_bent_block(const scene::Body& body,
                                        const structure::Box& block,
                                        const structure::Mesh& mesh,
                                        const KernelReach& reach) {
    const structure::Mesh straight = structure::box_mesh(block);
    const bool ring = mesh.nodes.size() < straight.nodes.size();
    const structure::Continues continues{ring, false, false};
    auto markers = rows_in_block(straight, DryFaces(body, straight, continues), reach,
                                 continues, ring);
    for (PlacedMarker& marker : markers)
        marker.point.node = mesh.elements[marker.point.element];
    return markers;
}

// Markers of a sheet of any shape: thinned-out layers across its thickness.
std::vector<PlacedMarker> in_layers(const structure::Mesh& mesh,
                                    const structure::Sheet& sheet, double thickness_m,
                                    const DryFaces& dry, const KernelReach& reach) {
    const double apart_m = fitted::thinned_to * reach.grid_m,
                 fine_m = 0.125 * reach.grid_m;
    const auto rim = dry.without(structure::rim_of(mesh, sheet));
    const EvenPlanes layers = reach.layers(thickness_m);
    double depth_m = rim_depth_m(reach, thickness_m) + fitted::beyond_row * apart_m;
    if (layers.count > 1)
        depth_m = reach.depth_m(fitted::thinned_apart * reach.grid_m) -
                  (layers.count == 2 ? fitted::thinned_two : fitted::thinned_more) *
                      reach.grid_m;
    std::vector<std::vector<PlacedMarker>> dense;
    for (int i = 0; i < layers.count; ++i) {
        const double above_m =
            (i - 0.5 * (layers.count - 1)) * layers.apart * reach.grid_m;
        const auto side =
            above_m > 0 ? structure::SheetSide::top : structure::SheetSide::bottom;
        std::vector<PlacedMarker>& points = dense.emplace_back();
        for (const auto& p : structure::points_below_face(
                 mesh, sheet, side, 0.5 * thickness_m - std::abs(above_m), fine_m))
            points.push_back({p.point, p.area_m2 * layers.apart * reach.grid_m});
        draw_back(points, mesh, rim, depth_m, fine_m);
        begin_along(points, mesh, rim, depth_m + fine_m, fine_m);
    }
    return thinned(dense, mesh, apart_m, fine_m);
}

// Nodes of a lattice around the middle of the body that lie in it. Points of the mesh
// itself would lie otherwise in every mesh of the same body, and so would the few markers
// in a body six cells across; its drag changed by 3 %.
std::vector<PlacedMarker> lattice_in(const structure::Mesh& mesh,
                                     std::span<const PlacedMarker> volume, double apart_m,
                                     double node_m) {
    const structure::Bounds box = structure::bounds(mesh.nodes);
    const Vec3 middle = 0.5 * (box.low_m + box.high_m);
    // Every node in the body is as near to one of its points as these are apart.
    const auto near = static_cast<long>(std::ceil(0.5 * apart_m / node_m));
    std::set<std::array<long, 3>> nodes;
    for (const PlacedMarker& p : volume) {
        const Vec3 x = (1 / node_m) * (structure::position(mesh, p.point) - middle);
        for (long i = -near; i <= near; ++i)
            for (long j = -near; j <= near; ++j)
                for (long k = -near; k <= near; ++k)
                    nodes.insert({std::lround(x[0]) + i, std::lround(x[1]) + j,
                                  std::lround(x[2]) + k});
    }
    const structure::PointLocator locator(mesh);
    std::vector<PlacedMarker> inside;
    for (const auto& [i, j, k] : nodes) {
        const Vec3 x = middle + node_m * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
        const structure::MaterialPoint point = locator.nearest(x);
        if (structure::distance_m(structure::position(mesh, point), x) < 1e-6 * node_m)
            inside.push_back({point, 0});
    }
    return inside;
}

// Markers of any other body: an even shell below its wet surface, then the volume inside.
std::vector<PlacedMarker> in_volume(const structure::Mesh& mesh,
                                    std::span<const structure::SurfaceQuad> surface,
                                    const KernelReach& reach) {
    const double grid_m = reach.grid_m, fine_m = 0.125 * grid_m;
    const double depth_m =
        reach.depth_m(fitted::thinned_apart * grid_m) + fitted::beyond_edge * grid_m;
    const structure::PointLocator locator(mesh);
    std::vector<PlacedMarker> points;
    for (const auto& p : structure::surface_points(mesh, surface, fine_m)) {
        points.push_back(
            {locator.nearest(structure::position(mesh, p.point) - depth_m * p.normal),
             0});
    }
    draw_back(points, mesh, surface, depth_m - fine_m, fine_m);
    std::vector<PlacedMarker> volume;
    for (const auto& p : structure::volume_points(mesh, 4 * fine_m))
        volume.push_back({p.point, p.volume_m3});
    std::vector<PlacedMarker> inside = lattice_in(mesh, volume, 4 * fine_m, 2 * fine_m);
    draw_back(inside, mesh, surface, depth_m + 4 * fine_m, 2 * fine_m);
    auto markers =
        thinned_shell(points, inside, mesh, fitted::thinned_to * grid_m, fine_m);
    // The markers' volumes must add up to the body's: with more, balls diverge at
    // relaxation times above 1.
    share_volume(markers, mesh, volume, grid_m);
    return markers;
}

// Markers of a mesh that is no block.
std::vector<PlacedMarker> in_mesh(const structure::Mesh& mesh,
                                  const std::optional<structure::Sheet>& sheet,
                                  const DryFaces& dry, const KernelReach& reach) {
    if (!sheet)
        return in_volume(mesh, dry.without(structure::boundary_quads(mesh)), reach);
    const double thickness_m = structure::volume_m3(mesh) / area_m2(mesh, *sheet);
    return in_layers(mesh, *sheet, thickness_m, dry, reach);
}

// Marks the core of a sheet, the markers below two layers of others, seen from faces and
// rims alike.
void find_core(std::vector<PlacedMarker>& markers, const structure::Mesh& mesh,
               const DryFaces& dry, const KernelReach& reach) {
    const double grid_m = reach.grid_m;
    const double core_m = reach.depth_m(grid_m) + 1.5 * grid_m;
    std::vector<structure::MaterialPoint> points;
    for (const PlacedMarker& m : markers) points.push_back(m.point);
    const auto depth =
        structure::depths(mesh, dry.without(structure::boundary_quads(mesh)), points,
                          0.5 * grid_m, core_m + grid_m);
    for (std::size_t i = 0; i < markers.size(); ++i) markers[i].core = depth[i] > core_m;
}

std::optional<CarriedLayer> one_layer(const structure::Mesh& mesh,
                                      const std::optional<structure::Sheet>& sheet,
                                      const KernelReach& reach) {
    if (!sheet) return std::nullopt;
    const double thickness_m = structure::volume_m3(mesh) / area_m2(mesh, *sheet);
    if (!reach.takes_one_layer(thickness_m)) return std::nullopt;
    const double carried = reach.resolved_wall.thickness({1, 1});
    return CarriedLayer{thickness_m, carried * reach.grid_m};
}

}  // namespace

std::optional<CarriedLayer> carried_layer(const scene::Scene& scene, std::size_t number,
                                          const structure::Mesh& mesh) {
    if (scene.coupling->immersed_boundary.forcing != coupler::Forcing::no_slip)
        return std::nullopt;
    const scene::Body& body = scene.bodies[number];
    return one_layer(
        mesh, structure::find_sheet(mesh, spans_fluid(*scene.fluid, body, mesh, true)),
        reach_in(scene));
}

std::vector<PlacedMarker> no_slip_markers(const scene::Body& body,
                                          const structure::Mesh& mesh,
                                          const DryFaces& dry, const KernelReach& reach,
                                          const structure::Continues& continues) {
    const auto sheet = structure::find_sheet(mesh, continues);
    const auto layer = one_layer(mesh, sheet, reach);
    std::vector<PlacedMarker> markers;
    bool has_thin_axis = true;
    if (std::holds_alternative<structure::Box>(body.mesh)) {
        markers = rows_in_block(mesh, dry, reach, continues);
        const Vec3 size = structure::bounds(mesh.nodes).extent_m();
        has_thin_axis = thin_axes(size, continues).size() == 1;
    } else if (const auto* arc = std::get_if<structure::Arc>(&body.mesh)) {
        markers = in_bent_block(body, structure::straightened(*arc), mesh, reach);
    } else if (const auto* helix = std::get_if<structure::Helix>(&body.mesh)) {
        markers = in_bent_block(body, structure::straightened(*helix), mesh, reach);
    } else {
        markers = in_mesh(mesh, sheet, dry, reach);
    }
    share_faces(markers, mesh, sheet, layer && has_thin_axis, dry, reach);
    share_among_elements(markers, mesh);
    if (layer) {
        for (PlacedMarker& marker : markers)
            marker.beyond_m3 =
                marker.volume_m3 * (layer->carried_m - layer->thickness_m) / reach.grid_m;
    } else if (sheet) {
        find_core(markers, mesh, dry, reach);
    }
    return markers;
}

}  // namespace magfsi::bodies
