// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/hexahedron.h"

#include <Eigen/LU>
#include <cmath>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Jacobian dX_i / dxi_j of the map from local coordinates.
Eigen::Matrix3d jacobian(const Positions8& nodes_m, const Vec3& xi) {
    return nodes_m.transpose() * shape_gradients(xi);
}

void refuse_inverted(const Positions8& nodes_m, int element_number) {
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 xi{node_sign(corner, 0), node_sign(corner, 1), node_sign(corner, 2)};
        const double det = jacobian(nodes_m, xi).determinant();
        if (!(det > 0)) {
            refuse(
                "element {} of the mesh is inverted or flat at its corner {} (Jacobian "
                "{:.3g} m3, must be positive): nodes go a = i + 2 j + 4 k, right-handed",
                element_number, corner, det);
        }
    }
}

}  // namespace

std::array<double, 8> shape_values(const Vec3& xi) {
    std::array<double, 8> values{};
    for (int a = 0; a < 8; ++a) {
        double product = 1;
        for (int d = 0; d < 3; ++d) product *= 0.5 * (1 + node_sign(a, d) * xi[d]);
        values[a] = product;
    }
    return values;
}

Positions8 shape_gradients(const Vec3& xi) {
    Positions8 gradients;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) {
            double product = 0.5 * node_sign(a, d);
            for (int other = 0; other < 3; ++other) {
                if (other != d) product *= 0.5 * (1 + node_sign(a, other) * xi[other]);
            }
            gradients(a, d) = product;
        }
    }
    return gradients;
}

HexahedronIntegrals integrate_hexahedron(const Positions8& nodes_m, int element_number) {
    refuse_inverted(nodes_m, element_number);
    HexahedronIntegrals out;
    out.laplacian.setZero();
    out.gradient.setZero();
    const double q = 1 / std::sqrt(3.0);
    for (int g = 0; g < 8; ++g) {
        const Vec3 xi{q * node_sign(g, 0), q * node_sign(g, 1), q * node_sign(g, 2)};
        const Eigen::Matrix3d jac = jacobian(nodes_m, xi);
        const double weight = jac.determinant();
        const Positions8 gradients = shape_gradients(xi) * jac.inverse();
        out.laplacian += weight * gradients * gradients.transpose();
        out.gradient += weight * gradients;
        out.volume += weight;
        const auto values = shape_values(xi);
        for (int a = 0; a < 8; ++a) out.node_volume[a] += weight * values[a];
    }
    return out;
}

Positions8 gather(std::span<const Vec3> nodes_m, const Hexahedron& element) {
    Positions8 out;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) out(a, d) = nodes_m[element[a]][d];
    }
    return out;
}

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

}  // namespace magfsi::structure
