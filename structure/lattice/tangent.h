// SPDX-License-Identifier: GPL-2.0-or-later
// Tangent stiffness of one element: the second derivative of eq. (1), or of the energy
// with the material's stiffening.
#pragma once

#include <Eigen/Dense>

#include "structure/lattice/element.h"

namespace magfsi::structure {

// Volume V = V0 J with its first and second derivatives, which are exact, as V is cubic
// in the positions for every variant. V and dV/dx alone (element_volume) cost a fifth of
// all three.
struct VolumeDerivatives {
    double volume_m3 = 0;
    Positions8 gradient_m2;  // dV / dx
    Matrix24 hessian_m;      // d2V / dx dx; row 3 a + d: node a, direction d
};

// x_m: present positions of the nodes, near the origin.
VolumeDerivatives volume_derivatives(const ElementReference& reference,
                                     const Positions8& x_m);

// First and second derivative [Pa] of U(J) = K/2 ln^2 J - G ln J.
struct VolumetricStress {
    double pressure_pa = 0;  // dU/dJ; -G at rest, where it balances the springs
    double modulus_pa = 0;   // d2U/dJ2
};
VolumetricStress volumetric_stress(const Material& material, double volume_ratio);

// Tangent of springs and volume term: G L (x) I + p d2V + modulus/V0 dV dV^T [N/m]. With
// p = dU/dJ of the same J it is the second derivative of the energy; the mixed iteration
// passes a pressure of its own. Hourglass energy and stiffening are not included.
Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const VolumeDerivatives& volume, const VolumetricStress& stress);

// Second derivative of element_energy at x [N/m], the hourglass energy included.
Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const Positions8& x_m);

}  // namespace magfsi::structure
