#include <Eigen/Dense>
#include <algorithm>

#include "structure/mesh/inverse_map.h"
#include "structure/mesh/sheet.h"

namespace magfsi::structure {
namespace {

Eigen::Vector3d on_level(const Mesh& mesh, const std::array<int, 4>& level,
                         const std::array<double, 4>& shape) {
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    for (int a = 0; a < 4; ++a) {
        out += shape[a] * Eigen::Vector3d(mesh.nodes[level[a]].data());
    }
    return out;
}

// Between two levels: the layer and how far up in it, 0 to 1.
struct Height {
    std::size_t layer = 0;
    double share = 0;
};

// Half the way up the column at one place of it, along the line through its levels.
Height half_way(const Mesh& mesh, const SheetColumn& column,
                const std::array<double, 4>& shape) {
    std::vector<double> up{0};
    for (std::size_t l = 0; l + 1 < column.levels.size(); ++l) {
        up.push_back(up.back() + (on_level(mesh, column.levels[l + 1], shape) -
                                  on_level(mesh, column.levels[l], shape))
                                     .norm());
    }
    // A middle on a level, but for rounding, belongs to the layer above, as in locate.
    const double half = 0.5 * up.back() * (1 + 1e-12);
    const auto above = std::ranges::upper_bound(up, half);
    const auto layer = static_cast<std::size_t>(above - up.begin()) - 1;
    return {layer, std::max(0.0, (0.5 * up.back() - up[layer]) / (*above - up[layer]))};
}

MaterialPoint middle(const Mesh& mesh, const SheetColumn& column, double u, double v) {
    const auto shape = quad_shape(u, v);
    const auto [layer, share] = half_way(mesh, column, shape);
    MaterialPoint out;
    out.element = column.elements[layer];
    out.node = mesh.elements[out.element];
    for (int a = 0; a < 4; ++a) {
        const auto place = [&](std::size_t level) {
            return std::ranges::find(out.node, column.levels[level][a]) -
                   out.node.begin();
        };
        out.weight[place(layer)] = shape[a] * (1 - share);
        out.weight[place(layer + 1)] = shape[a] * share;
    }
    return out;
}

Vec3 position(const Mesh& mesh, const MaterialPoint& point) {
    Vec3 x{};
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d)
            x[d] += point.weight[a] * mesh.nodes[point.node[a]][d];
    }
    return x;
}

}  // namespace

std::vector<SurfacePoint> mid_surface_points(const Mesh& mesh, const Sheet& sheet,
                                             double spacing_m) {
    std::vector<SurfacePoint> points;
    for (const SheetColumn& column : sheet.columns) {
        const std::array<Vec3, 4> corners_m{position(mesh, middle(mesh, column, 0, 0)),
                                            position(mesh, middle(mesh, column, 1, 0)),
                                            position(mesh, middle(mesh, column, 1, 1)),
                                            position(mesh, middle(mesh, column, 0, 1))};
        for (const QuadCell& cell : cut_quad(corners_m, spacing_m)) {
            points.push_back(
                {middle(mesh, column, cell.u, cell.v), cell.area_m2, cell.normal});
        }
    }
    return points;
}

}  // namespace magfsi::structure
