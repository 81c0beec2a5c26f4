// Volume of a deformed element and its gradient: the term of eqs. (5) and (6).
#pragma once

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

struct VolumeAndGradient {
    double volume_m3 = 0;
    Positions8 gradient_m2;  // dV / dx_a
};

// Exact volume of the trilinear hexahedron; cubic in the positions.
VolumeAndGradient exact_volume(const Positions8& x_m);

// V0 det F with the mean deformation gradient F = sum_a x_a b_a^T / V0.
VolumeAndGradient mean_volume(const Positions8& x_m,
                              const Positions8& reference_gradient_m2,
                              double reference_volume_m3);

}  // namespace magfsi::structure
