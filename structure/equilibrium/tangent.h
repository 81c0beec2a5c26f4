// Tangent stiffness of one element: the second derivative of eq. (1).
#pragma once

#include "structure/equilibrium/volume_derivatives.h"

namespace magfsi::structure {

// U(J) = K/2 ln^2 J - G ln J: its first and second derivative [Pa].
struct VolumetricStress {
    double pressure_pa = 0;  // dU/dJ; -G at rest, where it balances the springs
    double modulus_pa = 0;   // d2U/dJ2
};
VolumetricStress volumetric_stress(const Material& material, double volume_ratio);

// G L (x) I + p d2V + modulus/V0 dV dV^T [N/m]. With p = dU/dJ of the same J this is the
// second derivative of the energy; the mixed iteration passes a pressure of its own.
Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const VolumeDerivatives& volume, const VolumetricStress& stress);

// The second derivative of element_energy at x.
Matrix24 element_tangent(const ElementReference& reference, const Material& material,
                         const Positions8& x_m);

}  // namespace magfsi::structure
