// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/marker_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "structure/mesh/body_points.h"

namespace magfsi::bodies {

namespace {

// Markers sorted into cubic bins, for searches of the nearest ones.
class Bins {
  public:
    Bins(std::span<const PlacedMarker> markers, const structure::Mesh& mesh, double size)
        : size_m_(size) {
        for (const PlacedMarker& m : markers) {
            at_.push_back(structure::position(mesh, m.point));
            bins_[bin(at_.back())].push_back(at_.size() - 1);
        }
    }

    // Numbers of the markers nearest to x. Searches growing shells of bins: everything
    // beyond shell n is further away than n bin sizes. Returns all markers that are
    // equally near up to rounding, since a choice among them would break the symmetry of
    // a body and its mirror image. Does not end without any marker.
    std::vector<std::size_t> nearest(const Vec3& x) const {
        constexpr double rounding = 1e-9;
        std::vector<std::size_t> best;
        double best2 = std::numeric_limits<double>::infinity();
        for (int shell = 0;; ++shell) {
            for_each_in(bin(x), shell, [&](std::size_t m) {
                double r2 = 0;
                for (std::size_t d = 0; d < 3; ++d)
                    r2 += (at_[m][d] - x[d]) * (at_[m][d] - x[d]);
                if (r2 > best2 * (1 + rounding)) return;
                if (r2 < best2 * (1 - rounding)) best.clear();
                best.push_back(m);
                best2 = std::min(best2, r2);
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

// Gradients of the eight shape functions at a point of an element [1/m].
std::array<Eigen::Vector3d, 8> shape_gradient(const structure::Mesh& mesh,
                                              const structure::MaterialPoint& point) {
    const auto sign = [](std::size_t a, int axis) { return a >> axis & 1U ? 1.0 : -1.0; };
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (std::size_t a = 0; a < 8; ++a)
        for (int d = 0; d < 3; ++d) at[d] += point.weight[a] * sign(a, d);
    std::array<Eigen::Vector3d, 8> slope;
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();  // dx_i / d xi_j
    for (std::size_t a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) {
            slope[a][d] = 0.125 * sign(a, d);
            for (int other = 0; other < 3; ++other)
                if (other != d) slope[a][d] *= 1 + at[other] * sign(a, other);
        }
        const Vec3& x = mesh.nodes[point.node[a]];
        jacobian += Eigen::Vector3d(x[0], x[1], x[2]) * slope[a].transpose();
    }
    const Eigen::Matrix3d inverse = jacobian.inverse().transpose();
    for (Eigen::Vector3d& of_node : slope) of_node = inverse * of_node;
    return slope;
}

// Weights of shape functions below this are zero up to rounding.
constexpr double on_border = 1e-9;

// The material points of a marker on the border between elements, one in each of them, if
// its area depends on nodes beyond the border and so on one of the elements alone; else
// the marker's own point. elements_of: the elements of each node.
std::vector<structure::MaterialPoint> across_borders(
    const PlacedMarker& marker, const structure::Mesh& mesh,
    const std::vector<std::vector<int>>& elements_of) {
    std::map<int, double> weight;  // shape functions of the nodes on the border
    double longest = 0, beyond = 0;
    for (std::size_t a = 0; a < 8; ++a) {
        const double edge =
            std::max(std::abs(marker.first_edge[a]), std::abs(marker.second_edge[a]));
        longest = std::max(longest, edge);
        if (std::abs(marker.point.weight[a]) > on_border)
            weight[marker.point.node[a]] = marker.point.weight[a];
        else
            beyond = std::max(beyond, edge);
    }
    std::vector<structure::MaterialPoint> points;
    if (beyond <= on_border * longest) return {marker.point};
    for (const int e : elements_of[weight.begin()->first]) {
        structure::MaterialPoint point;
        point.element = e;
        point.node = mesh.elements[e];
        std::size_t found = 0;
        for (std::size_t a = 0; a < 8; ++a) {
            const auto known = weight.find(point.node[a]);
            point.weight[a] = known == weight.end() ? 0 : known->second;
            found += known != weight.end();
        }
        if (found == weight.size()) points.push_back(point);
    }
    return points;
}

// Vector area that the marker stands for in the undeformed body [m2].
Vec3 area_of(const PlacedMarker& marker, const structure::Mesh& mesh) {
    Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = first;
    for (std::size_t a = 0; a < 8; ++a) {
        const Vec3& x = mesh.nodes[marker.point.node[a]];
        first += marker.first_edge[a] * Eigen::Vector3d(x[0], x[1], x[2]);
        second += marker.second_edge[a] * Eigen::Vector3d(x[0], x[1], x[2]);
    }
    const Eigen::Vector3d area = first.cross(second);
    return {area[0], area[1], area[2]};
}

bool all_in(const std::set<int>& face, const structure::SurfaceQuad& quad) {
    return std::ranges::all_of(quad.node, [&](int node) { return face.contains(node); });
}

}  // namespace

std::vector<std::vector<std::size_t>> nearest_markers(
    std::span<const PlacedMarker> markers, const structure::Mesh& mesh,
    std::span<const Vec3> points, double spacing_m) {
    const Bins bins(markers, mesh, spacing_m);
    std::vector<std::vector<std::size_t>> nearest;
    for (const Vec3& x : points) nearest.push_back(bins.nearest(x));
    return nearest;
}

// The edges are two orthogonal vectors of equal length in the plane of the area. As
// weights of the nodes they are the gradients of the shape functions along them, so that
// the deformation gradient carries them.
void set_area(PlacedMarker& marker, const structure::Mesh& mesh, const Vec3& area_m2) {
    const Eigen::Vector3d area(area_m2[0], area_m2[1], area_m2[2]);
    if (!(area.norm() > 0)) return;
    const Eigen::Vector3d first = area.unitOrthogonal();
    const Eigen::Vector3d second = area.normalized().cross(first);
    const auto gradient = shape_gradient(mesh, marker.point);
    const double length = std::sqrt(area.norm());
    for (std::size_t a = 0; a < 8; ++a) {
        const Eigen::Vector3d slope = length * gradient[a];
        marker.first_edge[a] = slope.dot(first);
        marker.second_edge[a] = slope.dot(second);
    }
}

void share_among_elements(std::vector<PlacedMarker>& markers,
                          const structure::Mesh& mesh) {
    std::vector<std::vector<int>> elements_of(mesh.nodes.size());
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        for (const int node : mesh.elements[e]) elements_of[node].push_back(e);
    std::vector<PlacedMarker> all;
    for (const PlacedMarker& marker : markers) {
        const auto pieces = across_borders(marker, mesh, elements_of);
        if (pieces.size() == 1) {
            all.push_back(marker);
            continue;
        }
        const Vec3 area_m2 = area_of(marker, mesh);
        const auto share = 1.0 / pieces.size();
        for (const structure::MaterialPoint& point : pieces) {
            PlacedMarker& piece = all.emplace_back(marker);
            piece.point = point;
            piece.volume_m3 *= share;
            set_area(piece, mesh,
                     {share * area_m2[0], share * area_m2[1], share * area_m2[2]});
        }
    }
    markers = std::move(all);
}

void share_surface(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                   std::span<const structure::SurfaceQuad> surface, double spacing_m,
                   int faces) {
    const Bins bins(markers, mesh, spacing_m);
    std::map<std::size_t, Vec3> areas;
    // Pieces of half a spacing are small enough for every marker of an even layer to get
    // some.
    for (const auto& p : structure::surface_points(mesh, surface, 0.5 * spacing_m)) {
        const auto nearest = bins.nearest(structure::position(mesh, p.point));
        const double area_m2 = faces * p.area_m2 / nearest.size();
        for (const std::size_t marker : nearest) areas[marker] += area_m2 * p.normal;
    }
    for (const auto& [marker, area] : areas) set_area(markers[marker], mesh, area);
}

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
    // A body that lies within the skin as a whole keeps its markers.
    if (!kept.empty()) markers = std::move(kept);
}

DryFaces::DryFaces(const scene::Body& body, const structure::Mesh& mesh,
                   const structure::Continues& continues)
    : ends_(mesh, continues) {
    std::vector<std::string> held = body.clamps;
    for (const auto& motion : body.prescribed_motion)
        held.insert(held.end(), motion.faces.begin(), motion.faces.end());
    std::set<int> all;
    for (const std::string& face : held) {
        const auto found = mesh.faces.find(face);
        if (found == mesh.faces.end()) continue;
        all.insert(found->second.begin(), found->second.end());
        clamped_.emplace_back(found->second.begin(), found->second.end());
    }
    if (std::ranges::all_of(structure::boundary_quads(mesh),
                            [&](const auto& quad) { return all_in(all, quad); }))
        clamped_.clear();
}

std::vector<structure::SurfaceQuad> DryFaces::without(
    std::vector<structure::SurfaceQuad> surface) const {
    std::erase_if(surface, [this](const auto& quad) {
        return ends_.hold(quad) || std::ranges::any_of(clamped_, [&](const auto& face) {
                   return all_in(face, quad);
               });
    });
    return surface;
}

}  // namespace magfsi::bodies
