// J of one element with its first and second derivatives: all that the tangent needs to
// know about an element variant.
#pragma once

#include <Eigen/Dense>

#include "structure/lattice/element_energy.h"

namespace magfsi::structure {

// Degrees of freedom of one element: 3 a + d for coordinate d of node a.
using Vector24 = Eigen::Matrix<double, 24, 1>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;

// V = V0 J, cubic in the positions for every variant, so these are exact.
struct VolumeDerivatives {
    double volume_m3 = 0;
    Vector24 gradient_m2;  // dV / dx
    Matrix24 hessian_m;    // d2V / dx dx
};

// V and dV/dx alone cost a fifth of all three.
struct VolumeSlope {
    double volume_m3 = 0;
    Vector24 gradient_m2;
};

VolumeSlope volume_slope(const ElementReference& reference, const Positions8& x_m);
VolumeDerivatives volume_derivatives(const ElementReference& reference,
                                     const Positions8& x_m);

}  // namespace magfsi::structure
