// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/body_points.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "structure/lattice/hexahedron.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Number of parts along local axis d, by the longest of the four edges in its direction.
int parts(const Positions8& x, int d, double spacing_m) {
    double longest = 0;
    for (int a = 0; a < 8; ++a) {
        if (((a >> d) & 1) != 0) continue;
        longest = std::max(longest, (x.row(a + (1 << d)) - x.row(a)).norm());
    }
    // The margin keeps rounding of the quotient from adding a part.
    return std::max<int>(1, std::ceil(longest / spacing_m - 1e-9));
}

// Local coordinate of the middle of part i of `count`.
double middle(int i, int count) {
    return (2 * i + 1.0) / count - 1;
}

std::vector<VolumePoint> points_of(const Mesh& mesh, int element, double spacing_m) {
    const Positions8 x = gather(mesh.nodes, mesh.elements[element]);
    const int n[3] = {parts(x, 0, spacing_m), parts(x, 1, spacing_m),
                      parts(x, 2, spacing_m)};
    std::vector<VolumePoint> points;
    double sum = 0;
    for (int i = 0; i < n[0] * n[1] * n[2]; ++i) {
        const Vec3 xi{middle(i % n[0], n[0]), middle(i / n[0] % n[1], n[1]),
                      middle(i / n[0] / n[1], n[2])};
        const Eigen::Matrix3d jacobian = x.transpose() * shape_gradients(xi);
        points.push_back({{mesh.elements[element], shape_values(xi), element},
                          jacobian.determinant()});
        sum += points.back().volume_m3;
    }
    const double scale = integrate_hexahedron(x, element).volume / sum;
    for (VolumePoint& point : points) point.volume_m3 *= scale;
    return points;
}

using Bin = std::array<int, 3>;

// Surface points in cubes of the edge size_m: the nearest point within size_m is in one
// of 27 cubes.
class Bins {
  public:
    Bins(const Mesh& mesh, std::span<const SurfaceQuad> surface, double spacing_m,
         double size_m)
        : size_m_(size_m) {
        for (const auto& p : surface_points(mesh, surface, spacing_m)) {
            const Vec3 x = position(mesh, p.point);
            bins_[bin(x)].push_back(x);
        }
    }

    // At most size_m, which stands for all points that are farther.
    double distance_to(const Vec3& x) const {
        double least = size_m_ * size_m_;
        const Bin middle = bin(x);
        for (int i = 0; i < 27; ++i) {
            const auto found =
                bins_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1,
                            middle[2] + i / 9 - 1});
            if (found == bins_.end()) continue;
            for (const Vec3& y : found->second) {
                const double dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
                least = std::min(least, dx * dx + dy * dy + dz * dz);
            }
        }
        return std::sqrt(least);
    }

  private:
    Bin bin(const Vec3& x) const {
        Bin b;
        for (std::size_t d = 0; d < 3; ++d)
            b[d] = static_cast<int>(std::floor(x[d] / size_m_));
        return b;
    }
    double size_m_;
    std::map<Bin, std::vector<Vec3>> bins_;
};

}  // namespace

std::vector<SurfacePoint> surface_points(const Mesh& mesh,
                                         std::span<const SurfaceQuad> surface,
                                         double spacing_m) {
    std::vector<SurfacePoint> points;
    for (const SurfaceQuad& quad : surface) {
        const auto local = face_corners(quad.face);
        for (const QuadCell& cell : cut_quad(corners(mesh.nodes, quad.node), spacing_m)) {
            SurfacePoint out{{}, cell.area_m2, cell.normal};
            out.point.element = quad.element;
            out.point.node = mesh.elements[quad.element];
            const auto shape = quad_shape(cell.u, cell.v);
            for (int a = 0; a < 4; ++a) out.point.weight[local[a]] = shape[a];
            points.push_back(out);
        }
    }
    return points;
}

std::vector<VolumePoint> volume_points(const Mesh& mesh, double spacing_m) {
    if (!(spacing_m > 0)) {
        refuse("points {:g} m apart in a body found, the spacing must be positive",
               spacing_m);
    }
    std::vector<VolumePoint> points;
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
        const auto found = points_of(mesh, e, spacing_m);
        points.insert(points.end(), found.begin(), found.end());
    }
    return points;
}

double volume_m3(const Mesh& mesh) {
    double sum = 0;
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
        sum += integrate_hexahedron(gather(mesh.nodes, mesh.elements[e]), e).volume;
    return sum;
}

std::vector<double> depths(const Mesh& mesh, std::span<const SurfaceQuad> surface,
                           std::span<const MaterialPoint> points, double spacing_m,
                           double limit_m) {
    const Bins bins(mesh, surface, spacing_m, limit_m);
    std::vector<double> found;
    found.reserve(points.size());
    for (const MaterialPoint& p : points)
        found.push_back(bins.distance_to(position(mesh, p)));
    return found;
}

}  // namespace magfsi::structure
