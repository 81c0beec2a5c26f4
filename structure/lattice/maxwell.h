// SPDX-License-Identifier: GPL-2.0-or-later
// Viscoelasticity: Maxwell branches of modulus G_k and time tau_k beside the elastic
// energy.
//
// A branch is a network of chains that break and form anew in the shape that the body has
// then (Linder, Tkachuk, Miehe, J. Mech. Phys. Solids 59 (2011) 2134): its symmetric A
// follows the inverse of C = F^T F,
//   dA/dt = (C^-1 - A) / tau,   energy  G_k/2 V0 [tr(A C) - 3 - ln det(A C)],
//   stress (second Piola-Kirchhoff)  G_k (A - C^-1),
//   dissipation  G_k/(2 tau) V0 [tr(A C) + tr((A C)^-1) - 6]  >= 0.
// At once it is eq. (1)'s solid of shear modulus G_k without K, in small strains a spring
// and a dashpot in series; volume is left to the elastic energy. Hourglass vectors have
// the same law for the strains of hourglass_energy and of the mode xyz, linear in them,
// with the moduli of Kelvin-Voigt damping (element.h).
//
// The state of a branch is D = A - C^-1 and the like for the hourglass strains: with the
// strains e (-C^-1 and those of hourglass vectors) D' = e' - D / tau. A step that changes
// e evenly from e0 to e1 has exactly
//   D1 = D0 exp(-dt/tau) + (e1 - e0) (1 - exp(-dt/tau)) tau/dt.
// Forces follow from positions alone. The stiffness of a step is at most the sum of all
// moduli, whatever the times: the stable step is that of a solid of G + sum G_k.
#pragma once

#include <array>
#include <vector>

#include "structure/lattice/element.h"
#include "structure/lattice/kernel_data.h"

namespace magfsi::structure {

// Factors of the branches of a material for a step. dt_s = 0: the state stays.
std::vector<MaxwellFactors> maxwell_factors(const Material& material, double dt_s);

// Modulus lambda' of the plate for the modulus 1 (viscous_plate_lambda_pa_s).
double maxwell_plate_lambda(const Material& material);

// Sum of the moduli of all branches [Pa].
double branch_modulus_pa(const Material& material);

// Storage and loss modulus [Pa] at small strains and an angular frequency, of elasticity,
// branches and Kelvin-Voigt viscosity: G' + i G''.
struct ComplexModulus {
    double storage_pa = 0, loss_pa = 0;
};
ComplexModulus complex_modulus(const Material& material, double omega_rad_s);

// The branches of one element in their plainest form, the reference that the fast kernel
// is tested against.
struct MaxwellElement {
    using Numbers = std::array<double, maxwell_numbers>;
    Numbers strain{};               // e at the last positions
    std::vector<Numbers> branch{};  // D of each

    // Strains e at given positions.
    static Numbers strain_at(const ElementReference& reference, const Positions8& x_m);
    // Relaxed at these positions.
    static MaxwellElement at_rest(const ElementReference& reference,
                                  const Material& material, const Positions8& x_m);

    struct State {
        Positions8 force_n;
        double energy_j = 0, dissipation_w = 0;
    };
    // Takes the branches to these positions and returns what they do there.
    State advance(const ElementReference& reference, const Material& material,
                  const Positions8& x_m, double dt_s);
};

}  // namespace magfsi::structure
