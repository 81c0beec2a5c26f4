#include <Eigen/Dense>
#include <algorithm>
#include <limits>

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

// At `depth_m` below one end of the column at one place of it, but no deeper than half
// the way, along the line through its levels.
Height height_at(const Mesh& mesh, const SheetColumn& column, SheetSide side,
                 double depth_m, const std::array<double, 4>& shape) {
    std::vector<double> up{0};
    for (std::size_t l = 0; l + 1 < column.levels.size(); ++l) {
        up.push_back(up.back() + (on_level(mesh, column.levels[l + 1], shape) -
                                  on_level(mesh, column.levels[l], shape))
                                     .norm());
    }
    const double depth = std::min(depth_m, 0.5 * up.back());
    const double height = side == SheetSide::bottom ? depth : up.back() - depth;
    // A height on a level, but for rounding, belongs to the layer above, as in locate.
    const auto above =
        std::upper_bound(up.begin() + 1, up.end() - 1, height * (1 + 1e-12));
    const auto layer = static_cast<std::size_t>(above - up.begin()) - 1;
    return {layer, std::max(0.0, (height - up[layer]) / (*above - up[layer]))};
}

MaterialPoint point_in(const Mesh& mesh, const SheetColumn& column, SheetSide side,
                       double depth_m, double u, double v) {
    const auto shape = quad_shape(u, v);
    const auto [layer, share] = height_at(mesh, column, side, depth_m, shape);
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

}  // namespace

std::vector<SurfacePoint> points_below_face(const Mesh& mesh, const Sheet& sheet,
                                            SheetSide side, double depth_m,
                                            double spacing_m) {
    std::vector<SurfacePoint> points;
    for (const SheetColumn& column : sheet.columns) {
        const auto at = [&](double u, double v) {
            return point_in(mesh, column, side, depth_m, u, v);
        };
        const std::array<Vec3, 4> corners_m{
            position(mesh, at(0, 0)), position(mesh, at(1, 0)), position(mesh, at(1, 1)),
            position(mesh, at(0, 1))};
        for (const QuadCell& cell : cut_quad(corners_m, spacing_m))
            points.push_back({at(cell.u, cell.v), cell.area_m2, cell.normal});
    }
    return points;
}

std::vector<SurfacePoint> mid_surface_points(const Mesh& mesh, const Sheet& sheet,
                                             double spacing_m) {
    return points_below_face(mesh, sheet, SheetSide::top,
                             std::numeric_limits<double>::infinity(), spacing_m);
}

}  // namespace magfsi::structure
