#include "structure/mesh/inverse_map.h"

#include <algorithm>
#include <cmath>

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

Vector3d mapped(const Positions8& nodes_m, const Vec3& xi) {
    const auto shape = shape_values(xi);
    return nodes_m.transpose() * Eigen::Map<const Eigen::Vector<double, 8>>(shape.data());
}

Vector3d vector(const Vec3& x) {
    return Vector3d(x[0], x[1], x[2]);
}

Vector3d on_quad(const Corners4& x, double u, double v) {
    const auto shape = quad_shape(u, v);
    Vector3d out = Vector3d::Zero();
    for (int a = 0; a < 4; ++a) out += shape[a] * vector(x[a]);
    return out;
}

// Gauss-Newton on the distance, from the middle; may end outside the unit square.
std::array<double, 2> foot_of_perpendicular(const Corners4& x, const Vector3d& point) {
    double u = 0.5, v = 0.5;
    for (int step = 0; step < 20; ++step) {
        Eigen::Matrix<double, 3, 2> tangents;
        tangents.col(0) = (1 - v) * vector(x[1]) + v * vector(x[2]) -
                          (1 - v) * vector(x[0]) - v * vector(x[3]);
        tangents.col(1) = (1 - u) * vector(x[3]) + u * vector(x[2]) -
                          (1 - u) * vector(x[0]) - u * vector(x[1]);
        const Vector3d gap = point - on_quad(x, u, v);
        const Eigen::Vector2d change =
            (tangents.transpose() * tangents).ldlt().solve(tangents.transpose() * gap);
        if (!change.allFinite()) break;
        u = std::clamp(u + change[0], -1.0, 2.0);
        v = std::clamp(v + change[1], -1.0, 2.0);
        if (change.norm() < 1e-13) break;
    }
    return {u, v};
}

double nearest_on_edge(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
    return std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
}

}  // namespace

std::optional<Vec3> inverse_map(const Positions8& nodes_m, const Vec3& point_m) {
    const Vector3d target = vector(point_m);
    // Below the rounding of coordinates of the element's size and position.
    const double done_m = 1e-15 * nodes_m.cwiseAbs().maxCoeff() +
                          1e-14 * (nodes_m.row(7) - nodes_m.row(0)).norm();
    Vec3 xi{};
    Vector3d gap = target - mapped(nodes_m, xi);
    for (int step = 0; step < 50 && gap.norm() > done_m; ++step) {
        const Eigen::Matrix3d jacobian = nodes_m.transpose() * shape_gradients(xi);
        const Vector3d change = jacobian.partialPivLu().solve(gap);
        if (!change.allFinite()) return std::nullopt;
        // Far outside, the trilinear map may fold: no step over more than an element.
        double scale = std::min(1.0, 2 / change.cwiseAbs().maxCoeff());
        bool better = false;
        for (int halving = 0; halving < 8 && !better; ++halving, scale *= 0.5) {
            Vec3 trial = xi;
            for (int d = 0; d < 3; ++d) trial[d] += scale * change[d];
            const Vector3d left = target - mapped(nodes_m, trial);
            if (left.norm() >= gap.norm()) continue;
            xi = trial;
            gap = left;
            better = true;
        }
        if (!better) break;
    }
    // Rounding can end the search above `done_m`; a thousandth of a billionth of the
    // element is as good as found.
    if (gap.norm() > 1e-12 * (nodes_m.row(7) - nodes_m.row(0)).norm() + done_m) {
        return std::nullopt;
    }
    return xi;
}

std::array<double, 4> quad_shape(double u, double v) {
    return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

std::array<double, 2> nearest_on_quad(const Corners4& corners_m, const Vec3& point_m) {
    const Vector3d point = vector(point_m);
    const auto [u, v] = foot_of_perpendicular(corners_m, point);
    if (u >= 0 && u <= 1 && v >= 0 && v <= 1) return {u, v};
    static constexpr std::array<std::array<double, 2>, 4> at{
        {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<double, 2> best{};
    double least = INFINITY;
    for (int a = 0; a < 4; ++a) {
        const int b = (a + 1) % 4;
        const double t =
            nearest_on_edge(vector(corners_m[a]), vector(corners_m[b]), point);
        const double pu = (1 - t) * at[a][0] + t * at[b][0];
        const double pv = (1 - t) * at[a][1] + t * at[b][1];
        const double away = (on_quad(corners_m, pu, pv) - point).norm();
        if (away < least) {
            least = away;
            best = {pu, pv};
        }
    }
    return best;
}

}  // namespace magfsi::structure
