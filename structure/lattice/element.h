// SPDX-License-Identifier: GPL-2.0-or-later
// One element of the lattice model: spring network, volume term, hourglass energy. Its
// energy is eq. (1), summed over the element as in eqs. (2) to (4):
//
//   W = G/2 (sum_ab L_ab x_a . x_b - 3 V0) + V0 (K/2 ln^2 J - G ln J).
//
// In a homogeneous state the first term is G/2 V0 (I1 - 3). The element assumed_strain
// adds hourglass_energy.
#pragma once

#include <Eigen/Core>
#include <array>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

using Matrix24 = Eigen::Matrix<double, 24, 24>;  // row 3 a + d: node a, direction d

// Spring matrix L [m] with W_springs = G/2 sum_ab L_ab x_a . x_b. Its off-diagonal
// entries with the sign reversed are the 28 spring stiffnesses of eqs. (2) to (4); flat
// bricks have negative stiffnesses, and that is right.
//
// full: L_ab = integral of grad N_a . grad N_b.
// assumed_strain: L = b b^T / V0 + Gamma C Gamma^T, the family of matrices that
// reproduces linear fields exactly. C is that of full reduced to the entry of the mode
// xyz, and scaled so that a brick of edges l has 3 times the smallest of the (l_i l_j)^2
// where full has their sum; hourglass_energy covers the other modes.
Matrix8 spring_matrix(const Positions8& nodes_m, const HexahedronIntegrals& integrals,
                      ElementVariant variant);

// Hourglass energy of the element assumed_strain: the part of the strain energy that is
// due to the variation of the strain within the element.
//
// After Belytschko and Bindeman, Comput. Methods Appl. Mech. Eng. 105 (1993) 225, those
// strains of the hourglass modes are kept that a bent or twisted plate really has; the
// parasitic shears that lock thin elements are left out. There are three groups, one for
// each local direction zeta along which a strain varies linearly: the normal strains E_11
// and E_22 along the other two directions, and their shear E_12. The stress through each
// such plane is zero, as a plate may get thinner where it is pulled, so that the modulus
// is that of plane stress and the element does not lock at large K either.
//
// Strains are Green's, E_ij = (u_i . v_j + ...) / 2 with u_i half the present edges and v
// the present hourglass vectors, so that the energy is invariant under rotations. Indices
// are raised by the metric of the present edges where eq. (1) implies it: the bending
// stiffness of a stretched element follows eq. (1), and a bent element has the right
// stiffness in tension.

// Hadamard modes of the hourglass vectors, in their order here: xy, xz, yz, xyz. The
// energy is that of the first three.
inline constexpr std::array<int, 4> hourglass_vector_modes{3, 5, 6, 7};

// Reference data of hourglass energy and damping. Half edges u_i = sum_a edge(a, i) x_a
// and hourglass vectors v_j = sum_a hourglass(a, j) x_a. v_j is zero in every homogeneous
// state: v_j = mode_j - F X_j with the mean deformation gradient F.
struct HourglassReference {
    Eigen::Matrix<double, 8, 3> edge = Eigen::Matrix<double, 8, 3>::Zero();
    Eigen::Matrix<double, 8, 4> hourglass = Eigen::Matrix<double, 8, 4>::Zero();
    Eigen::Matrix<double, 4, 3> offset_m = Eigen::Matrix<double, 4, 3>::Zero();  // X_j
    // For each group's direction the inverse metric of the other two half edges at rest
    // [1/m2].
    std::array<Eigen::Matrix2d, 3> metric{
        Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
    double volume_m3 = 0;
};

// nodes_m: positions at rest; integrals: those of the same element.
HourglassReference hourglass_reference(const Positions8& nodes_m,
                                       const HexahedronIntegrals& integrals);

// Reference state of one element: all that its energy and damping need.
struct ElementReference {
    ElementVariant variant = ElementVariant::full;
    Matrix8 spring_matrix;  // [m]
    Positions8 gradient;    // b_a = integral of grad N_a [m2]
    double volume = 0;      // V0 [m3]
    // Integral of N_a [m3]
    std::array<double, 8> node_volume{};
    // Used by the energy of assumed_strain and by the viscosity of both variants
    HourglassReference hourglass;
};

// Reference state for nodes at rest. Throws std::invalid_argument, with the element's
// number, on an inverted element.
ElementReference element_reference(const Positions8& nodes_m, ElementVariant variant,
                                   int element_number);

// Present volume of an element and its derivative by the positions.
struct VolumeAndGradient {
    double volume_m3 = 0;
    Positions8 gradient_m2;  // dV / dx_a
};

// Exact volume of the trilinear hexahedron, which is cubic in the positions.
VolumeAndGradient exact_volume(const Positions8& x_m);

// Volume V0 det F by the mean deformation gradient F = sum_a x_a b_a^T / V0.
VolumeAndGradient mean_volume(const Positions8& x_m,
                              const Positions8& reference_gradient_m2,
                              double reference_volume_m3);

// Volume J V0 of the element's variant: exact for full, by the mean F for assumed_strain.
VolumeAndGradient element_volume(const ElementReference& reference,
                                 const Positions8& x_m);

// Lame constant lambda' of plane stress [Pa]: 2 G K / (K + 2 G).
double plane_stress_lambda_pa(const Material& material);

// Products u_i . v_j at index 3 i + j, for the three bending modes j.
using HourglassProducts = Eigen::Matrix<double, 9, 1>;
// dE/d(u_i . v_j) of the linear law at rest, for the products themselves or their rates,
// with the moduli g and lambda'.
HourglassProducts hourglass_stress(const HourglassReference& reference, double g,
                                   double lambda, const HourglassProducts& products);

// Hourglass energy at given positions.
struct HourglassState {
    double energy_j = 0;
    Positions8 gradient_n;  // dE / dx_a
};

// Hourglass energy: the sum over the three groups of
//
//   E = V0/3 {G/2 tr(M0 eps M eps) + q [G/2 tr(A^2) + lambda'/2 (tr A)^2]},
//   q = 1 - beta + beta det M / det M0,  beta = K / (K + 2 G),  lambda' of plane stress,
//
// where M is the inverse metric of the present edges, M0 that at rest, eps the strain at
// zeta = 1, A = M eps, and 1/3 the mean of zeta^2. It is the second variation of eq. (1)
// at the present stretch for a plate that is free to get thinner. The first term comes
// from G/2 |F|^2, which does not depend on the stretch, the second from the thickness,
// which goes as one over the area (beta = 1) if the volume is constant. At rest E is G
// eps : eps + lambda'/2 (tr eps)^2.
HourglassState hourglass_energy(const HourglassReference& reference,
                                const Material& material, const Positions8& x_m);

// Second derivative of the hourglass energy, d2E / dx dx [N/m].
Matrix24 hourglass_tangent(const HourglassReference& reference, const Material& material,
                           const Positions8& x_m);

// Kelvin-Voigt damping of one element in its plainest form, the reference that the fast
// kernel is tested against. The stress is 2 eta Edot (second Piola-Kirchhoff) of the mean
// deformation gradient F with Green's rate Edot = sym(F^T Fdot), and likewise for the
// strains of the hourglass vectors, with G replaced by eta and lambda' by 2 eta (K / (K +
// 2 G))^2, which follows from the rate at which a plate of this material gets thinner.
// The mode xyz dissipates V0 / 3 eta min_k(p_k) sum_i p_i (d(u_i . v_xyz)/dt)^2, with p
// the inverse squares of the half edges. All rates are those of scalar products and
// vanish in rigid motions; the forces are the adjoint, so that their power is minus the
// dissipation. eta is the material's viscosity.
struct ViscousState {
    double dissipation_w = 0;  // minus the power of the forces, never negative
    // On each node
    Positions8 force_n;
};

ViscousState viscous_element(const ElementReference& reference, const Material& material,
                             const Positions8& x_m, const Positions8& v_m_s);

// Modulus lambda' of the viscous plate [Pa s].
double viscous_plate_lambda_pa_s(const Material& material);

// Matrix C of the viscous forces -C v in the undeformed element [N s/m].
Matrix24 viscous_damping_at_rest(const ElementReference& reference,
                                 const Material& material, const Positions8& nodes_m);

}  // namespace magfsi::structure
