#include "structure/mesh/volume_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {
namespace {

// Parts along local axis d: by the longest of the four edges in its direction.
int parts(const Positions8& x, int d, double spacing_m) {
    double longest = 0;
    for (int a = 0; a < 8; ++a) {
        if (((a >> d) & 1) != 0) continue;
        longest = std::max(longest, (x.row(a + (1 << d)) - x.row(a)).norm());
    }
    // Rounding of the quotient does not add a part.
    return std::max(1, static_cast<int>(std::ceil(longest / spacing_m - 1e-9)));
}

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

}  // namespace

std::vector<VolumePoint> volume_points(const Mesh& mesh, double spacing_m) {
    if (!(spacing_m > 0)) {
        throw std::invalid_argument(fmt::format(
            "points {:g} m apart in a body found, the spacing must be positive",
            spacing_m));
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

}  // namespace magfsi::structure
