// Markers of forcing no_slip: even rows about a grid spacing apart, in one layer through
// thin sheets.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "adapters/bodies/marker_surface.h"
#include "adapters/bodies/scene_to_body.h"
#include "adapters/scene/effective.h"
#include "fluid_lbm/units.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"

namespace magfsi::bodies {

namespace {

using structure::Vec3;

// Distances of markers, in grid spacings: closer ones make the marker system nearly
// singular, wider ones leak.
constexpr double widest_row = 1.2, thinned_to = 1.0;
// How far the area of a thinned-out outer row ends outside of it: with which disks of 12
// and 16 spacings swung broadside have the exact added mass (tests/validation/no_slip).
constexpr double beyond_row = 0.4;
// Layers through the thickness, in grid spacings; where two would be closer, one is.
constexpr double closest_layers = 0.9;

bool has_one_layer(const KernelReach& reach, double thickness_m) {
    return thickness_m < 2 * reach.face_m + closest_layers * reach.grid_m;
}

// A sheet of thickness t with square edges moves as much fluid as one without thickness
// that reaches 0.31 to 0.35 t further (boundary elements; t up to a tenth of the width),
// and displaces as much as a tenth of t more would move.
constexpr double square_edge = 0.44;

// From the rim to where the area of the markers ends.
double rim_depth_m(const KernelReach& reach, double thickness_m) {
    const double of_layers_m = reach.face_m - 0.5 * reach.grid_m;
    if (!has_one_layer(reach, thickness_m)) return of_layers_m;
    return std::max(0.0, reach.edge_m - square_edge * thickness_m);
}

// Even rows over one axis of a box: their places and their distance.
struct Rows {
    std::vector<double> at_m;
    double apart_m = 0;
};

Rows even_rows(double low_m, double high_m, double widest_m) {
    const int n =
        std::max(1, static_cast<int>(std::ceil((high_m - low_m) / widest_m - 1e-9)));
    Rows rows{{}, (high_m - low_m) / n};
    for (int i = 0; i < n; ++i) rows.at_m.push_back(low_m + (i + 0.5) * rows.apart_m);
    return rows;
}

// Across the thickness: in the middle, or from one face to the other.
Rows layers(double low_m, double high_m, const KernelReach& reach) {
    const double thickness_m = high_m - low_m;
    if (has_one_layer(reach, thickness_m))
        return {{low_m + 0.5 * thickness_m}, reach.grid_m};
    const double between_m = thickness_m - 2 * reach.face_m;
    const int gaps = static_cast<int>(between_m / reach.grid_m + 1 - closest_layers);
    Rows rows{{}, between_m / std::max(1, gaps)};
    for (int i = 0; i <= std::max(1, gaps); ++i)
        rows.at_m.push_back(low_m + reach.face_m + i * rows.apart_m);
    return rows;
}

// Whether fluid meets an end of a box.
bool wet(std::span<const structure::SurfaceQuad> surface, const structure::Mesh& mesh,
         std::size_t axis, double end_m, double slack_m) {
    return std::ranges::any_of(surface, [&](const structure::SurfaceQuad& quad) {
        return std::ranges::all_of(quad.node, [&](int node) {
            return std::abs(mesh.nodes[static_cast<std::size_t>(node)][axis] - end_m) <
                   slack_m;
        });
    });
}

// One layer stands for both faces, whose areas would cancel.
constexpr int both = 2;
std::vector<structure::SurfaceQuad> top_of(const structure::Sheet& sheet) {
    std::vector<structure::SurfaceQuad> top;
    for (const auto& column : sheet.columns) top.push_back(column.top);
    return top;
}

// A block: rows along its two longer axes, layers across the thinnest.
std::vector<PlacedMarker> in_block(const structure::Mesh& mesh,
                                   const std::optional<structure::Sheet>& sheet,
                                   const DryFaces& dry, const KernelReach& reach,
                                   const structure::Continues& continues) {
    const structure::Bounds block = structure::bounds(mesh.nodes);
    const Vec3 size = block.extent_m();
    std::size_t thin = 0;  // never along an axis on which the body goes on
    for (std::size_t d = 1; d < 3; ++d)
        if (continues[thin] || (!continues[d] && size[d] < size[thin])) thin = d;
    const auto surface = dry.without(structure::boundary_quads(mesh));
    const double depth_m = rim_depth_m(reach, size[thin]), grid_m = reach.grid_m;
    std::array<Rows, 3> rows;
    for (std::size_t d = 0; d < 3; ++d) {
        const double slack_m = 1e-6 * size[d];
        const bool low = wet(surface, mesh, d, block.low_m[d], slack_m);
        const bool high = wet(surface, mesh, d, block.high_m[d], slack_m);
        if (d == thin) {
            rows[d] = layers(block.low_m[d], block.high_m[d], reach);
            continue;
        }
        const double most_m = 0.25 * size[d];  // of tiny bodies half is left
        rows[d] = even_rows(block.low_m[d] + (low ? std::min(depth_m, most_m) : 0),
                            block.high_m[d] - (high ? std::min(depth_m, most_m) : 0),
                            widest_row * grid_m);
    }
    const structure::PointLocator locator(mesh);
    const double volume_m3 = rows[0].apart_m * rows[1].apart_m * rows[2].apart_m;
    std::vector<PlacedMarker> markers;
    for (const double z : rows[2].at_m)
        for (const double y : rows[1].at_m)
            for (const double x : rows[0].at_m)
                markers.push_back({locator.nearest({x, y, z}), volume_m3});
    if (sheet && rows[thin].at_m.size() == 1)
        share_surface(markers, mesh, top_of(*sheet), grid_m, both);
    else
        share_surface(markers, mesh, surface, grid_m);
    return markers;
}

double distance(const Vec3& a, const Vec3& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Of points that are close together those that are at least `apart_m` from each other;
// each stands for the points that are nearest to it.
std::vector<PlacedMarker> thinned(const std::vector<PlacedMarker>& points,
                                  const structure::Mesh& mesh, double apart_m) {
    std::vector<PlacedMarker> kept;
    std::map<std::array<long, 3>, std::vector<Vec3>> taken;
    for (const PlacedMarker& p : points) {
        const Vec3 x = structure::position(mesh, p.point);
        std::array<long, 3> bin;
        for (std::size_t d = 0; d < 3; ++d) bin[d] = std::lround(x[d] / apart_m);
        bool free = true;
        for (int n = 0; n < 27 && free; ++n) {
            const auto found = taken.find(
                {bin[0] + n % 3 - 1, bin[1] + n / 3 % 3 - 1, bin[2] + n / 9 - 1});
            if (found == taken.end()) continue;
            free = std::ranges::none_of(found->second, [&](const Vec3& other) {
                return distance(other, x) < apart_m;
            });
        }
        if (!free) continue;
        taken[bin].push_back(x);
        kept.push_back(p);
        kept.back().volume_m3 = 0;
    }
    std::vector<Vec3> at;
    for (const PlacedMarker& p : points) at.push_back(structure::position(mesh, p.point));
    const auto nearest = nearest_markers(kept, mesh, at, apart_m);
    for (std::size_t i = 0; i < points.size(); ++i)
        kept[nearest[i]].volume_m3 += points[i].volume_m3;
    return kept;
}

// Those within depth_m of the surface first, each nearest to the one before: thinned out
// they are an even row.
void begin_along(std::vector<PlacedMarker>& points, const structure::Mesh& mesh,
                 std::span<const structure::SurfaceQuad> surface, double depth_m,
                 double fine_m) {
    std::vector<structure::MaterialPoint> at;
    for (const PlacedMarker& p : points) at.push_back(p.point);
    const auto depth = structure::depths(mesh, surface, at, 0.5 * fine_m, 2 * depth_m);
    std::vector<PlacedMarker> row, inside;
    for (std::size_t i = 0; i < points.size(); ++i)
        (depth[i] < depth_m ? row : inside).push_back(points[i]);
    for (std::size_t i = 1; i < row.size(); ++i) {
        const Vec3 last = structure::position(mesh, row[i - 1].point);
        const auto from_last = [&](const PlacedMarker& p) {
            return distance(structure::position(mesh, p.point), last);
        };
        const auto next = row.begin() + static_cast<std::ptrdiff_t>(i);
        std::iter_swap(next, std::ranges::min_element(next, row.end(), {}, from_last));
    }
    row.insert(row.end(), inside.begin(), inside.end());
    points = std::move(row);
}

// Any other mesh: thin sheets in the middle of their thickness, bodies through their
// volume, both below what bounds them, thinned out.
std::vector<PlacedMarker> in_mesh(const structure::Mesh& mesh,
                                  const std::optional<structure::Sheet>& sheet,
                                  const DryFaces& dry, const KernelReach& reach) {
    const double grid_m = reach.grid_m;
    const auto surface = dry.without(structure::boundary_quads(mesh));
    const double apart_m = thinned_to * grid_m, fine_m = 0.125 * grid_m;
    std::vector<PlacedMarker> points;
    double area_m2 = 0;
    if (sheet) {
        for (const auto& p : structure::mid_surface_points(mesh, *sheet, fine_m)) {
            points.push_back({p.point, p.area_m2 * grid_m});
            area_m2 += p.area_m2;
        }
    }
    const double thickness_m = sheet ? structure::volume_m3(mesh) / area_m2 : INFINITY;
    const bool thin = has_one_layer(reach, thickness_m);
    if (thin) {
        const auto rim = dry.without(structure::rim_of(mesh, *sheet));
        const double depth_m = rim_depth_m(reach, thickness_m) + beyond_row * apart_m;
        draw_back(points, mesh, rim, depth_m, fine_m);
        begin_along(points, mesh, rim, depth_m + fine_m, fine_m);
    } else {
        points.clear();
        for (const auto& p : structure::volume_points(mesh, 4 * fine_m))
            points.push_back({p.point, p.volume_m3});
        draw_back(points, mesh, surface, reach.face_m, 2 * fine_m);
    }
    auto markers = thinned(points, mesh, apart_m);
    if (thin)
        share_surface(markers, mesh, top_of(*sheet), grid_m, both);
    else
        share_surface(markers, mesh, surface, grid_m);
    return markers;
}

// In grid spacings, from the response of the lattice, shear wave by shear wave, to
// markers that move along their plane (tests/validation/no_slip/lattice_response.py): how
// far outside of the outer of several layers the wall stands in steady flow.
double face(coupler::Kernel kernel, bool small_magic_number) {
    if (kernel == coupler::Kernel::two_point) return small_magic_number ? 0.60 : 0.33;
    return small_magic_number ? 0.79 : 0.58;
}

// In grid spacings: with which a plate swung broadside has the exact added mass, or with
// the larger magic number a disk in a creeping stream errs as much broadside as edgewise
// (tests/validation/no_slip); not known for the 4-point kernel.
double edge(coupler::Kernel kernel, bool small_magic_number) {
    if (kernel == coupler::Kernel::two_point) return small_magic_number ? 0.64 : 0.48;
    return small_magic_number ? 0.93 : 0.75;
}

// In grid spacings, by the same theory, at Stokes layers of 1 (small magic numbers)
// and 8.
double carried(coupler::Kernel kernel, bool small_magic_number) {
    if (kernel == coupler::Kernel::two_point) return small_magic_number ? 1.46 : 1.02;
    return small_magic_number ? 1.75 : 1.34;
}

}  // namespace

KernelReach reach_in(const scene::Scene& scene) {
    const coupler::Kernel kernel = scene.coupling->immersed_boundary.kernel;
    const double grid_m = scene.fluid->finest_spacing_m();
    const bool small =
        scene::relaxation_time_at_bodies(scene).value_or(1) < fluid::trt_from;
    return {grid_m, face(kernel, small) * grid_m, edge(kernel, small) * grid_m,
            carried(kernel, small) * grid_m};
}

std::optional<CarriedLayer> carried_layer(const scene::Scene& scene, std::size_t number) {
    if (scene.coupling->immersed_boundary.forcing != coupler::Forcing::no_slip)
        return std::nullopt;
    const scene::Body& body = scene.bodies[number];
    const structure::Mesh mesh = to_mesh(body);
    const auto sheet = structure::find_sheet(mesh, spans_fluid(*scene.fluid, body, true));
    if (!sheet) return std::nullopt;
    double area_m2 = 0;
    for (const auto& top : top_of(*sheet))
        area_m2 += structure::quad_area(structure::corners(mesh.nodes, top.node));
    const double thickness_m = structure::volume_m3(mesh) / area_m2;
    const KernelReach reach = reach_in(scene);
    if (!has_one_layer(reach, thickness_m)) return std::nullopt;
    return CarriedLayer{thickness_m, reach.carried_m,
                        reach.grid_m * thickness_m / reach.carried_m};
}

std::vector<PlacedMarker> no_slip_markers(const scene::Body& body,
                                          const structure::Mesh& mesh,
                                          const DryFaces& dry, const KernelReach& reach,
                                          const structure::Continues& continues) {
    const auto sheet = structure::find_sheet(mesh, continues);
    if (std::holds_alternative<structure::Box>(body.mesh))
        return in_block(mesh, sheet, dry, reach, continues);
    return in_mesh(mesh, sheet, dry, reach);
}

}  // namespace magfsi::bodies
