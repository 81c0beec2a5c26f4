// SPDX-License-Identifier: GPL-2.0-or-later
// Strain stiffening: energies W(I1) in place of the neo-Hookean G/2 (I1 - 3) of eq. (1).
//
// An element has the energy V0 W(I1) of its mean I1, which follows from the neo-Hookean
// energy E0 of its springs and hourglass vectors (element.h): I1 = 2 E0 / (G V0). With
//   W(3 + s) = G/2 integral of f from 0 to s,   f = 2 W' / G,   f(0) = 1,
// springs and hourglass energy are scaled by f; the volume term stays as it is:
//   gradient  f dE0,   tangent  f d2E0 + 2 f' / (G V0) dE0 dE0^T.
#pragma once

#include "structure/lattice/element.h"
#include "structure/lattice/kernel_data.h"

namespace magfsi::structure {

// Largest (I1 - 3) over its limit at which a run goes on. Beyond it an element is 50
// times as stiff as at rest, and the law continues along its tangent.
inline constexpr double largest_share_of_limit = 0.98;

// The law of a material. Gent (1996): f = J / (J - s) with the limit J. Yeoh (1993): W =
// G/2 s + C2 s^2 + C3 s^3. Arruda and Boyce (1993), chains of N = L^2 segments that lock
// at the stretch L: f is the inverse Langevin function of y = sqrt(I1 / 3) / L over y,
// divided by its value at rest. Throws std::invalid_argument on a law that softens to
// nothing or whose limit is not allowed. A material without stiffening has f = 1.
StiffeningLaw stiffening_law(const Material& material);

// True if the material's law is not the neo-Hookean one.
inline bool stiffens(const Material& material) {
    if (!material.stiffening) return false;
    const auto* yeoh = std::get_if<Yeoh>(&*material.stiffening);
    return yeoh == nullptr || yeoh->c2_pa != 0 || yeoh->c3_pa != 0;
}

// f, its derivative, and its integral from 0 to s.
struct Stiffening1D {
    double factor = 1, slope = 0, integral = 0;
};
Stiffening1D stiffening_at(const StiffeningLaw& law, double s);

// Springs and hourglass energy of one element with the stiffening of its material.
struct Distortion {
    double energy_j = 0;    // zero at rest
    Positions8 gradient_n;  // dE/dx
    Stiffening1D law;       // at the present s
    double share = 0;       // s over its limit; 0 without a limit
    Positions8 unscaled_n;  // dE0/dx
};
// x_m: present positions, near the origin.
Distortion distortion(const ElementReference& reference, const Material& material,
                      const Positions8& x_m);

// What stiffening adds to the tangent of springs and hourglass energy. hourglass: that of
// hourglass_tangent, zero for full.
Matrix24 stiffening_tangent(const ElementReference& reference, const Material& material,
                            const Distortion& state, const Matrix24& hourglass);

}  // namespace magfsi::structure
