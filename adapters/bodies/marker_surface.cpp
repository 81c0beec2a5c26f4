// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/bodies/marker_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "structure/lattice/hexahedron.h"
#include "structure/mesh/body_points.h"

namespace magfsi::bodies {

namespace {

using structure::Vec3;

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
    // All that are as near but for rounding: one alone would be another one in the mirror
    // image of a body.
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

void share_surface(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                   std::span<const structure::SurfaceQuad> surface, double spacing_m,
                   int faces) {
    const Bins bins(markers, mesh, spacing_m);
    std::map<std::size_t, Vec3> areas;
    // So close that every marker of an even layer gets some.
    for (const auto& p : structure::surface_points(mesh, surface, 0.5 * spacing_m)) {
        const auto nearest = bins.nearest(structure::position(mesh, p.point));
        const double area_m2 = faces * p.area_m2 / static_cast<double>(nearest.size());
        for (const std::size_t marker : nearest)
            for (std::size_t d = 0; d < 3; ++d) areas[marker][d] += area_m2 * p.normal[d];
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
    if (!kept.empty()) markers = std::move(kept);  // a body all skin keeps what it has
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
