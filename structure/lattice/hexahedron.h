// SPDX-License-Identifier: GPL-2.0-or-later
// Trilinear hexahedron: shape functions, edges, and the integrals over its reference
// state that the lattice model is made of.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

using Positions8 = Eigen::Matrix<double, 8, 3>;  // one node a row, lexicographic order
using Matrix8 = Eigen::Matrix<double, 8, 8>;

// Local coordinate (-1 or 1) of node a along direction d.
inline double node_sign(int a, int d) {
    return ((a >> d) & 1) != 0 ? 1.0 : -1.0;
}

// Hadamard mode m (bit d set: factor xi_d) at node a: 1, x, y, xy, z, xz, yz, xyz.
inline double mode_sign(int m, int a) {
    double product = 1;
    for (int d = 0; d < 3; ++d) {
        if (((m >> d) & 1) != 0) product *= node_sign(a, d);
    }
    return product;
}

// N_a(xi) and dN_a/dxi at local coordinates xi in [-1, 1]^3.
std::array<double, 8> shape_values(const Vec3& xi);
Positions8 shape_gradients(const Vec3& xi);

struct HexahedronIntegrals {
    Matrix8 laplacian;                    // L_ab = integral of grad N_a . grad N_b [m]
    Positions8 gradient;                  // b_a = integral of grad N_a [m2]
    double volume = 0;                    // [m3]
    std::array<double, 8> node_volume{};  // integral of N_a [m3]
};

// 2x2x2 Gauss points. Throws std::invalid_argument that names the element where the map
// from local to reference coordinates is not right-handed.
HexahedronIntegrals integrate_hexahedron(const Positions8& nodes_m, int element_number);

Positions8 gather(std::span<const Vec3> nodes_m, const Hexahedron& element);

// Mean length of the four edges along each local direction [m], and their mean direction.
struct ElementEdges {
    Vec3 length_m{};
    std::array<Eigen::Vector3d, 3> direction;
};
ElementEdges element_edges(const Positions8& nodes_m);

}  // namespace magfsi::structure
