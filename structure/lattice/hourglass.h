// Hourglass energy of the element assumed_strain: what the strain energy of a homogeneous
// element lacks when the strain varies within it.
//
// Belytschko and Bindeman, Comput. Methods Appl. Mech. Eng. 105 (1993) 225: of the
// strains that the hourglass modes make, only those that a bent or twisted plate really
// has are kept; the parasitic shears that lock thin elements are left out. Three groups,
// one for each local direction zeta along which a strain varies linearly: the normal
// strains E_11, E_22 along the other two directions and their shear E_12. The stress
// through each such plane is zero (a plate is free to get thinner where it is pulled), so
// the modulus is that of plane stress and the element does not lock at large K either.
//
// Strains are Green's, E_ij = (u_i . v_j + ...) / 2 with u_i half the present edges and v
// the present hourglass vectors, so that the energy does not feel rotations.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

using Matrix24 = Eigen::Matrix<double, 24, 24>;  // row 3 a + d: node a, direction d

// Modes of the hourglass vectors, in their order here: xy, xz, yz, xyz. The energy is
// that of the first three.
inline constexpr std::array<int, 4> hourglass_vector_modes{3, 5, 6, 7};

// u_i = sum_a edge(a, i) x_a, v_j = sum_a hourglass(a, j) x_a; v_j is zero in every
// homogeneous state: v_j = mode_j - F X_j with the mean deformation gradient F.
struct HourglassReference {
    Eigen::Matrix<double, 8, 3> edge = Eigen::Matrix<double, 8, 3>::Zero();
    Eigen::Matrix<double, 8, 4> hourglass = Eigen::Matrix<double, 8, 4>::Zero();
    Eigen::Matrix<double, 4, 3> offset_m = Eigen::Matrix<double, 4, 3>::Zero();  // X_j
    // Inverse of the metric of the half edges (i, k) != the group's direction [1/m2].
    std::array<Eigen::Matrix2d, 3> metric{
        Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
    double volume_m3 = 0;
};

HourglassReference hourglass_reference(const Positions8& nodes_m,
                                       const HexahedronIntegrals& integrals);

// lambda of plane stress: 2 G K / (K + 2 G).
double plane_stress_lambda_pa(const Material& material);

// Covariant products u_i . v_j (nine numbers, 3 i + j), and what they are worth with
// shear modulus G and lambda': dE/d(u_i . v_j).
using HourglassProducts = Eigen::Matrix<double, 9, 1>;
HourglassProducts hourglass_stress(const HourglassReference& reference, double g,
                                   double lambda, const HourglassProducts& products);

struct HourglassState {
    double energy_j = 0;
    Positions8 gradient_n;  // dE / dx_a
};

// E = V0 / 3 sum over groups of [G eps : eps + lambda'/2 (tr eps)^2], lambda' of plane
// stress, eps the strain at zeta = 1; the mean of zeta^2 is 1/3.
HourglassState hourglass_energy(const HourglassReference& reference,
                                const Material& material, const Positions8& x_m);

// d2E / dx dx [N/m].
Matrix24 hourglass_tangent(const HourglassReference& reference, const Material& material,
                           const Positions8& x_m);

}  // namespace magfsi::structure
