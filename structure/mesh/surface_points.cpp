#include "structure/mesh/surface_points.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/mesh/inverse_map.h"

namespace magfsi::structure {
namespace {

using Corners = std::array<Eigen::Vector3d, 4>;

// Normal times area, per unit of u and v.
Eigen::Vector3d area_vector(const Corners& x, double u, double v) {
    const Eigen::Vector3d along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
    const Eigen::Vector3d along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
    return along_u.cross(along_v);
}

// Rounding of the quotient does not add a part.
int parts(double length_m, double spacing_m) {
    return std::max(1, static_cast<int>(std::ceil(length_m / spacing_m - 1e-9)));
}

}  // namespace

std::vector<QuadCell> cut_quad(const std::array<Vec3, 4>& corners_m, double spacing_m) {
    if (!(spacing_m > 0)) {
        throw std::invalid_argument(fmt::format(
            "points {:g} m apart on a surface found, the spacing must be positive",
            spacing_m));
    }
    Corners x;
    for (int a = 0; a < 4; ++a) x[a] = Eigen::Vector3d(corners_m[a].data());
    const int nu = parts(std::max((x[1] - x[0]).norm(), (x[2] - x[3]).norm()), spacing_m);
    const int nv = parts(std::max((x[3] - x[0]).norm(), (x[2] - x[1]).norm()), spacing_m);
    std::vector<QuadCell> cells;
    double sum = 0;
    for (int j = 0; j < nv; ++j) {
        for (int i = 0; i < nu; ++i) {
            const double u = (i + 0.5) / nu, v = (j + 0.5) / nv;
            const Eigen::Vector3d area = area_vector(x, u, v);
            const Eigen::Vector3d normal = area.normalized();
            cells.push_back({u, v, area.norm(), {normal[0], normal[1], normal[2]}});
            sum += area.norm();
        }
    }
    // The midpoint rule, scaled so that the quad keeps its area.
    const double scale =
        quad_area({corners_m.begin(), corners_m.end()}, {{0, 1, 2, 3}}) / sum;
    for (QuadCell& cell : cells) cell.area_m2 *= scale;
    return cells;
}

std::vector<SurfacePoint> surface_points(const Mesh& mesh,
                                         std::span<const SurfaceQuad> surface,
                                         double spacing_m) {
    std::vector<SurfacePoint> points;
    for (const SurfaceQuad& quad : surface) {
        std::array<Vec3, 4> corners_m;
        for (int a = 0; a < 4; ++a) corners_m[a] = mesh.nodes[quad.node[a]];
        const auto local = face_corners(quad.face);
        for (const QuadCell& cell : cut_quad(corners_m, spacing_m)) {
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

}  // namespace magfsi::structure
