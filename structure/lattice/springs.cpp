#include "structure/lattice/springs.h"

#include <algorithm>
#include <cmath>

namespace magfsi::structure {
namespace {

using Hourglass = Eigen::Matrix<double, 8, 4>;
constexpr std::array<int, 4> hourglass_modes{3, 6, 5, 7};  // xy, yz, xz, xyz
constexpr std::array<std::array<int, 2>, 3> mode_axes{{{0, 1}, {1, 2}, {0, 2}}};

// Hourglass vectors made blind to linear fields: gamma = h - b (X^T h) / V0.
Hourglass hourglass_vectors(const Positions8& nodes_m, const HexahedronIntegrals& in) {
    Hourglass gamma;
    for (int k = 0; k < 4; ++k) {
        Eigen::Matrix<double, 8, 1> h;
        for (int a = 0; a < 8; ++a) h(a) = mode_sign(hourglass_modes[k], a);
        gamma.col(k) = h - in.gradient * (nodes_m.transpose() * h) / in.volume;
    }
    return gamma;
}

// Square roots of the factors on the entries of C of the element full.
Eigen::Vector4d hourglass_scale(const Vec3& length, ElementVariant variant) {
    Eigen::Vector4d scale = Eigen::Vector4d::Ones();
    double smallest = INFINITY;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double li = length[mode_axes[k][0]];
        const double lj = length[mode_axes[k][1]];
        const double shorter = std::min(li, lj);
        scale(k) = std::sqrt(3 * shorter * shorter / (li * li + lj * lj));
        smallest = std::min(smallest, li * li * lj * lj);
        sum += li * li * lj * lj;
    }
    if (variant == ElementVariant::mean_f) return scale;
    return {0, 0, 0, std::sqrt(3 * smallest / sum)};
}

}  // namespace

ElementEdges element_edges(const Positions8& nodes_m) {
    ElementEdges edges;
    for (int d = 0; d < 3; ++d) {
        Eigen::Vector3d edge = Eigen::Vector3d::Zero();
        for (int a = 0; a < 8; ++a) {
            edge += 0.25 * node_sign(a, d) * nodes_m.row(a).transpose();
        }
        edges.length_m[d] = edge.norm();
        edges.direction[d] = edge.normalized();
    }
    return edges;
}

Matrix8 spring_matrix(const Positions8& nodes_m, const HexahedronIntegrals& in,
                      ElementVariant variant) {
    if (variant == ElementVariant::full) return in.laplacian;
    const Matrix8 mean = in.gradient * in.gradient.transpose() / in.volume;
    const Hourglass gamma = hourglass_vectors(nodes_m, in);
    // in.laplacian - mean = Gamma C Gamma^T, solved for C.
    const Eigen::Matrix4d inverse = (gamma.transpose() * gamma).inverse();
    Eigen::Matrix4d c =
        inverse * (gamma.transpose() * (in.laplacian - mean) * gamma) * inverse;
    const Eigen::Vector4d scale =
        hourglass_scale(element_edges(nodes_m).length_m, variant);
    c = scale.asDiagonal() * c * scale.asDiagonal();
    return mean + gamma * c * gamma.transpose();
}

std::array<double, 28> pair_springs(const Matrix8& spring_matrix) {
    std::array<double, 28> springs{};
    int k = 0;
    for (int a = 0; a < 8; ++a) {
        for (int b = a + 1; b < 8; ++b) springs[k++] = -spring_matrix(a, b);
    }
    return springs;
}

}  // namespace magfsi::structure
