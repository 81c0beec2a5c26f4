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

#include "adapters/bodies/scene_to_body.h"
#include "structure/lattice/hexahedron.h"
#include "structure/mesh/body_points.h"
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
    auto markers = surface || (sheet && !boundary.markers)
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
