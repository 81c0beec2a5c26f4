#include "adapters/bodies/marker_placement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <variant>

#include "adapters/bodies/scene_to_body.h"
#include "structure/lattice/hexahedron.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/sheet.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

namespace {

using structure::Vec3;

Vec3 middle(const structure::Mesh& mesh, const structure::SurfaceQuad& quad) {
    Vec3 x{};
    for (const int node : quad.node)
        for (std::size_t d = 0; d < 3; ++d)
            x[d] += mesh.nodes[static_cast<std::size_t>(node)][d] / 4;
    return x;
}

// Markers by the cubes of a grid, so that the nearest one is found among a few.
class Bins {
  public:
    Bins(std::span<const PlacedMarker> markers, const structure::Mesh& mesh, double size)
        : size_m_(size) {
        for (const PlacedMarker& m : markers) {
            at_.push_back(structure::position(mesh, m.point));
            bins_[bin(at_.back())].push_back(at_.size() - 1);
        }
    }

    // Searches growing shells of bins; what lies beyond shell n is further than n bins.
    std::size_t nearest(const Vec3& x) const {
        std::size_t best = 0;
        double best2 = std::numeric_limits<double>::infinity();
        for (int shell = 0;; ++shell) {
            for_each_in(bin(x), shell, [&](std::size_t m) {
                double r2 = 0;
                for (std::size_t d = 0; d < 3; ++d)
                    r2 += (at_[m][d] - x[d]) * (at_[m][d] - x[d]);
                if (r2 < best2) {
                    best2 = r2;
                    best = m;
                }
            });
            if (best2 <= std::pow(shell * size_m_, 2)) return best;
        }
    }

  private:
    using Bin = std::array<long, 3>;

    Bin bin(const Vec3& x) const {
        Bin b;
        for (std::size_t d = 0; d < 3; ++d) b[d] = std::lround(x[d] / size_m_);
        return b;
    }

    template <typename Visit>
    void for_each_in(const Bin& centre, int shell, Visit&& visit) const {
        for (long i = -shell; i <= shell; ++i)
            for (long j = -shell; j <= shell; ++j)
                for (long k = -shell; k <= shell; ++k) {
                    if (std::max({std::abs(i), std::abs(j), std::abs(k)}) != shell)
                        continue;
                    const auto found =
                        bins_.find({centre[0] + i, centre[1] + j, centre[2] + k});
                    if (found == bins_.end()) continue;
                    for (const std::size_t m : found->second) visit(m);
                }
    }

    double size_m_;
    std::vector<Vec3> at_;
    std::map<Bin, std::vector<std::size_t>> bins_;
};

// The marker stands for this vector area [m2], outward, of the undeformed body: there
// leakage is measured.
void set_area(PlacedMarker& marker, const structure::Mesh& mesh, const Vec3& area_m2) {
    const Eigen::Vector3d area(area_m2[0], area_m2[1], area_m2[2]);
    if (!(area.norm() > 0)) return;
    const Eigen::Vector3d first = area.unitOrthogonal();
    const Eigen::Vector3d second = area.normalized().cross(first);
    const int e = marker.point.element;
    const auto integrals = structure::integrate_hexahedron(
        structure::gather(mesh.nodes, mesh.elements[static_cast<std::size_t>(e)]), e);
    const double length = std::sqrt(area.norm());
    for (int a = 0; a < 8; ++a) {
        const Eigen::Vector3d slope =
            integrals.gradient.row(a).transpose() * (length / integrals.volume);
        marker.first_edge[static_cast<std::size_t>(a)] = slope.dot(first);
        marker.second_edge[static_cast<std::size_t>(a)] = slope.dot(second);
    }
}

// Each quad of the surface goes to the marker nearest to its middle: the areas of the
// markers add up to that of the surface.
void share_surface(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                   std::span<const structure::SurfaceQuad> surface, double spacing_m) {
    const Bins bins(markers, mesh, spacing_m);
    std::map<std::size_t, Vec3> areas;
    for (const structure::SurfaceQuad& quad : surface) {
        const Vec3 area =
            structure::quad_area_vector(structure::corners(mesh.nodes, quad.node));
        Vec3& sum = areas[bins.nearest(middle(mesh, quad))];
        for (std::size_t d = 0; d < 3; ++d) sum[d] += area[d];
    }
    for (const auto& [marker, area] : areas) set_area(markers[marker], mesh, area);
}

struct Spacings {
    double grid_m, marker_m;
};

// Thins the markers out towards a part of the surface: none within skin_m, smooth over
// one spacing so that the skin is not rounded to rows of markers.
void draw_back(std::vector<PlacedMarker>& markers, const structure::Mesh& mesh,
               std::span<const structure::SurfaceQuad> surface, double skin_m,
               double spacing_m) {
    if (surface.empty() || skin_m == 0) return;
    std::vector<structure::MaterialPoint> points;
    for (const PlacedMarker& m : markers) points.push_back(m.point);
    const std::vector<double> depth =
        structure::depths(mesh, surface, points, 0.5 * spacing_m, skin_m + spacing_m);
    std::vector<PlacedMarker> kept;
    for (std::size_t i = 0; i < markers.size(); ++i) {
        const double share = std::clamp((depth[i] - skin_m) / spacing_m + 0.5, 0.0, 1.0);
        if (share == 0) continue;
        kept.push_back(markers[i]);
        kept.back().volume_m3 *= share;
    }
    if (!kept.empty()) markers = std::move(kept);  // a body all skin keeps what it has
}

bool all_in(const std::set<int>& face, const structure::SurfaceQuad& quad) {
    return std::ranges::all_of(quad.node, [&](int node) { return face.contains(node); });
}

// What bounds the body but no fluid: the ends along axes on which it continues, and where
// it is clamped to something. A body that is held all around has fluid there.
class DryFaces {
  public:
    DryFaces(const scene::Body& body, const structure::Mesh& mesh,
             const structure::Continues& continues)
        : ends_(mesh, continues) {
        std::vector<std::string> held = body.clamps;
        for (const auto& motion : body.prescribed_motion)
            held.insert(held.end(), motion.faces.begin(), motion.faces.end());
        for (const std::string& face : held) {
            const auto found = mesh.faces.find(face);
            if (found == mesh.faces.end()) continue;
            std::set<int> nodes(found->second.begin(), found->second.end());
            if (!std::ranges::all_of(
                    structure::boundary_quads(mesh),
                    [&](const auto& quad) { return all_in(nodes, quad); }))
                clamped_.push_back(std::move(nodes));
        }
    }

    std::vector<structure::SurfaceQuad> without(
        std::vector<structure::SurfaceQuad> surface) const {
        std::erase_if(surface, [this](const auto& quad) {
            return ends_.hold(quad) || clamped(quad);
        });
        return surface;
    }

  private:
    bool clamped(const structure::SurfaceQuad& quad) const {
        return std::ranges::any_of(clamped_,
                                   [&](const auto& face) { return all_in(face, quad); });
    }

    structure::MeshEnds ends_;
    std::vector<std::set<int>> clamped_;
};

std::vector<PlacedMarker> on_sheet(const structure::Mesh& mesh,
                                   const structure::Sheet& sheet, bool both_faces,
                                   const DryFaces& dry,
                                   const coupler::ImmersedBoundary& boundary,
                                   const Spacings& spacing) {
    std::vector<PlacedMarker> markers;
    // faces: -1 the bottom, 1 the top, 2 both, of whose normals |U . n| sees no sign.
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

// --- forcing no_slip: well-conditioned markers -----------------------------------------

// Distances of markers, in grid spacings: closer ones make the marker system nearly
// singular, wider ones leak.
constexpr double widest_row = 1.2, thinned_to = 1.0;
// Sheets below this thickness, in grid spacings, have one layer of markers.
constexpr double one_layer_below = 1.4;

// In grid spacings. face: how far outside of a plane of markers its wall stands,
// E|X - Y| / 2 of two points spread by the kernel. edge: how far a sheet without
// thickness reaches beyond the area of its markers (broadside drag of a disk in creeping
// flow).
struct KernelReach {
    double face, edge;
};
KernelReach reach_of(coupler::Kernel kernel) {
    switch (kernel) {
        case coupler::Kernel::two_point:
            return {0.233, 0.74};
        case coupler::Kernel::three_point:
            return {0.312, 0.89};
        case coupler::Kernel::four_point:
            break;
    }
    return {0.414, 1.17};
}

// A sheet of thickness t with square edges moves as much fluid as one without thickness
// that reaches 0.31 to 0.35 t further (boundary elements; t up to a tenth of the width).
constexpr double square_edge = 0.345;

double rim_depth_m(const KernelReach& reach, double thickness_m, double grid_m) {
    return std::max(reach.face * grid_m, reach.edge * grid_m - square_edge * thickness_m);
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
Rows layers(double low_m, double high_m, double face_m, double grid_m) {
    const double thickness_m = high_m - low_m;
    if (thickness_m < one_layer_below * grid_m)
        return {{low_m + 0.5 * thickness_m}, grid_m};
    const double between_m = thickness_m - 2 * face_m;
    const int gaps =
        std::max(1, static_cast<int>(std::ceil(between_m / (widest_row * grid_m))));
    Rows rows{{}, between_m / gaps};
    for (int i = 0; i <= gaps; ++i)
        rows.at_m.push_back(low_m + face_m + i * rows.apart_m);
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

// A block: rows along its two longer axes, layers across the thinnest.
std::vector<PlacedMarker> in_block(const structure::Mesh& mesh, const DryFaces& dry,
                                   coupler::Kernel kernel, double grid_m) {
    const structure::Bounds block = structure::bounds(mesh.nodes);
    const Vec3 size = block.extent_m();
    const auto thin =
        static_cast<std::size_t>(std::ranges::min_element(size) - size.begin());
    const auto surface = dry.without(structure::boundary_quads(mesh));
    const KernelReach reach = reach_of(kernel);
    const double depth_m = rim_depth_m(reach, size[thin], grid_m);
    std::array<Rows, 3> rows;
    for (std::size_t d = 0; d < 3; ++d) {
        const double slack_m = 1e-6 * size[d];
        const bool low = wet(surface, mesh, d, block.low_m[d], slack_m);
        const bool high = wet(surface, mesh, d, block.high_m[d], slack_m);
        if (d == thin) {
            rows[d] =
                layers(block.low_m[d], block.high_m[d], reach.face * grid_m, grid_m);
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
    share_surface(markers, mesh, surface, grid_m);
    return markers;
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
                return std::hypot(other[0] - x[0], other[1] - x[1], other[2] - x[2]) <
                       apart_m;
            });
        }
        if (!free) continue;
        taken[bin].push_back(x);
        kept.push_back(p);
        kept.back().volume_m3 = 0;
    }
    const Bins bins(kept, mesh, apart_m);
    for (const PlacedMarker& p : points)
        kept[bins.nearest(structure::position(mesh, p.point))].volume_m3 += p.volume_m3;
    return kept;
}

// Any other mesh: thin sheets in the middle of their thickness, bodies through their
// volume, both below what bounds them, thinned out.
std::vector<PlacedMarker> in_mesh(const structure::Mesh& mesh,
                                  const std::optional<structure::Sheet>& sheet,
                                  const DryFaces& dry, coupler::Kernel kernel,
                                  double grid_m) {
    const KernelReach reach = reach_of(kernel);
    const auto surface = dry.without(structure::boundary_quads(mesh));
    const double apart_m = thinned_to * grid_m, fine_m = 0.25 * grid_m;
    std::vector<PlacedMarker> points;
    double area_m2 = 0;
    if (sheet) {
        for (const auto& p : structure::mid_surface_points(mesh, *sheet, fine_m)) {
            points.push_back({p.point, p.area_m2 * grid_m});
            area_m2 += p.area_m2;
        }
    }
    const double thickness_m = sheet ? structure::volume_m3(mesh) / area_m2 : INFINITY;
    if (thickness_m < one_layer_below * grid_m) {
        draw_back(points, mesh, dry.without(structure::rim_of(mesh, *sheet)),
                  rim_depth_m(reach, thickness_m, grid_m), fine_m);
    } else {
        points.clear();
        for (const auto& p : structure::volume_points(mesh, 2 * fine_m))
            points.push_back({p.point, p.volume_m3});
        draw_back(points, mesh, surface, reach.face * grid_m, fine_m);
    }
    auto markers = thinned(points, mesh, apart_m);
    share_surface(markers, mesh, surface, grid_m);
    return markers;
}

// Markers displace the body in the proportion of the fluid that they move.
void share_body(std::vector<PlacedMarker>& markers, double body_m3, int number) {
    double sum = 0;
    for (const PlacedMarker& m : markers) sum += m.volume_m3;
    for (PlacedMarker& m : markers) {
        m.displaced_m3 = m.volume_m3 * body_m3 / sum;
        m.body = number;
    }
}

}  // namespace

std::vector<PlacedMarker> place_markers(const scene::Body& body,
                                        const coupler::ImmersedBoundary& boundary,
                                        double grid_spacing_m, int number,
                                        const structure::Continues& continues) {
    const structure::Mesh mesh = to_mesh(body);
    const Spacings spacing{grid_spacing_m, boundary.marker_spacing * grid_spacing_m};
    const auto sheet = structure::find_sheet(mesh, continues);
    const bool surface =
        boundary.markers && *boundary.markers != coupler::Markers::volume;
    if (surface && !sheet) {
        throw std::invalid_argument(
            "body '" + body.name +
            "' is no sheet (columns of equally many elements between two large faces): "
            "its markers can only be coupling.immersed_boundary.markers: volume");
    }
    const DryFaces dry(body, mesh, continues);
    const bool both_faces = boundary.markers != coupler::Markers::mid_surface;
    const bool block = std::holds_alternative<structure::Box>(body.mesh);
    auto markers = boundary.forcing == coupler::Forcing::no_slip
                       ? block
                             ? in_block(mesh, dry, boundary.kernel, grid_spacing_m)
                             : in_mesh(mesh, sheet, dry, boundary.kernel, grid_spacing_m)
                   : surface || (sheet && !boundary.markers)
                       ? on_sheet(mesh, *sheet, both_faces, dry, boundary, spacing)
                       : through_volume(mesh, dry, boundary, spacing);
    share_body(markers, structure::volume_m3(mesh), number);
    return markers;
}

structure::Continues spans_fluid(const scene::Fluid& fluid, const scene::Body& body) {
    structure::Continues spans{};
    const structure::Mesh mesh = to_mesh(body);
    for (std::size_t d = 0; d < 3; ++d) {
        const auto& turn = body.initial.rotation;
        const bool turned = turn && (turn->plane[0] == static_cast<int>(d) ||
                                     turn->plane[1] == static_cast<int>(d));
        spans[d] = !turned &&
                   fluid.boundaries[2 * d].kind == fluid::BoundaryKind::periodic &&
                   extent(mesh, static_cast<int>(d)) >= fluid.box_m[d] * (1 - 1e-6);
    }
    return spans;
}

}  // namespace magfsi::bodies
