// Bending stiffness of a plate made of one kind of element, against Kirchhoff's.
#pragma once

#include <Eigen/Dense>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// D of the energy 1/2 k^T D k an area [N m], k = (k_pp, k_qq, k_pq) the curvatures along
// the in-plane axes p, q (those after the thickness axis in the order x, y, z, x).
using PlateStiffness = Eigen::Matrix3d;

// Kirchhoff's plate of the thickness T: T^3 / 12 [[2 G + l, l, 0], [l, 2 G + l, 0], [0,
// 0, 4 G]], l = 2 G K / (K + 2 G) for plane stress.
PlateStiffness kirchhoff_plate(const Material& material, double thickness_m);

// An endless plate of `layers` equal layers, each an endless repetition of one element
// (a prism between two planes normal to the thickness axis). Its nodes follow the
// curvature u_p = -(k_pp p + k_pq q) z, u_q = -(k_pq p + k_qq q) z, u_z = k_pp p^2 / 2 +
// k_qq q^2 / 2 + k_pq p q, plus the displacement of each level, the same for all of its
// nodes, of least energy. Linear in the curvature. Throws std::invalid_argument on a
// number of layers that is not positive or an inverted element.
PlateStiffness lattice_plate(ElementVariant variant, const Positions8& layer_m,
                             int thickness_axis, int layers, const Material& material);

}  // namespace magfsi::structure
