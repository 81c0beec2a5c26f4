// The spring network of eqs. (2) to (4): W_springs = G/2 x^T L x, summed over x, y, z.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// Spring matrix L [m] of one element; W = G/2 sum_ab L_ab x_a . x_b.
//
// full: L_ab = integral of grad N_a . grad N_b.
// mean_f: L = b b^T / V0 + Gamma C Gamma^T, the family of matrices that reproduces linear
// fields. C is that of full with the entries of the three bending modes scaled, so that a
// brick of edges l has 3 min(l_i, l_j)^2 where full has l_i^2 + l_j^2.
// assumed_strain: of C only the entry of the mode xyz, scaled so that a brick has 3 times
// the smallest of the (l_i l_j)^2 where full has their sum; hourglass.h has the rest.
Matrix8 spring_matrix(const Positions8& nodes_m, const HexahedronIntegrals& integrals,
                      ElementVariant variant);

// The 28 stiffnesses k_ab (a < b, row by row): W = G/2 sum k_ab |x_a - x_b|^2. They are
// the off-diagonals of L with the sign turned (the rows of L sum to zero); flat bricks
// have negative ones, rightly.
std::array<double, 28> pair_springs(const Matrix8& spring_matrix);

// Mean length of the four edges along each local direction [m], and their mean direction.
struct ElementEdges {
    Vec3 length_m{};
    std::array<Eigen::Vector3d, 3> direction;
};
ElementEdges element_edges(const Positions8& nodes_m);

}  // namespace magfsi::structure
