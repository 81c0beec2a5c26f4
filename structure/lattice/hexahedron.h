// SPDX-License-Identifier: GPL-2.0-or-later
// Trilinear hexahedron: shape functions, edges, and the integrals over its undeformed
// state from which the lattice model is built.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// One node per row, node a = i + 2 j + 4 k
using Positions8 = Eigen::Matrix<double, 8, 3>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

// Local coordinate, -1 or 1, of node a along direction d.
inline double node_sign(int a, int d) {
    return ((a >> d) & 1) != 0 ? 1.0 : -1.0;
}

// Value at node a of Hadamard mode m, the product of those xi_d whose bit d is set in m:
// 1, x, y, xy, z, xz, yz, xyz.
inline double mode_sign(int m, int a) {
    double product = 1;
    for (int d = 0; d < 3; ++d) {
        if (((m >> d) & 1) != 0) product *= node_sign(a, d);
    }
    return product;
}

// Shape functions N_a(xi) and their derivatives dN_a/dxi (one row per node) at local
// coordinates xi in [-1, 1]^3.
std::array<double, 8> shape_values(const Vec3& xi);
Positions8 shape_gradients(const Vec3& xi);

// Integrals over the undeformed element; gradients are by reference coordinates.
struct HexahedronIntegrals {
    Matrix8 laplacian;                    // L_ab = integral of grad N_a . grad N_b [m]
    Positions8 gradient;                  // b_a = integral of grad N_a [m2]
    double volume = 0;                    // [m3]
    std::array<double, 8> node_volume{};  // integral of N_a [m3]
};

// Integrals by 2x2x2 Gauss points. Throws std::invalid_argument, with the element's
// number, if the map from local to reference coordinates is not right-handed at a corner.
HexahedronIntegrals integrate_hexahedron(const Positions8& nodes_m, int element_number);

// Positions of an element's nodes.
Positions8 gather(std::span<const Vec3> nodes_m, const Hexahedron& element);

// Mean length of the four edges along each local direction [m], and their mean direction.
struct ElementEdges {
    Vec3 length_m{};
    std::array<Eigen::Vector3d, 3> direction;
};
ElementEdges element_edges(const Positions8& nodes_m);

}  // namespace magfsi::structure
