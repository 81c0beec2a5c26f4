// SPDX-License-Identifier: GPL-2.0-or-later
// What a choice of elements does to a plate's stiffness, before anything is run.
#pragma once

#include <Eigen/Core>
#include <string>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// D of the energy 1/2 k^T D k per area [N m], k = (k_pp, k_qq, k_pq) the curvatures along
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

// Stiffness of the mesh over the exact one, less 1, in small deformation: negative is too
// soft. Where a mode has two directions, the worse one.
struct ElementAdvice {
    double bending_error = 0;  // of plates and of narrow beams, about both in-plane axes
    double twist_error = 0;
    double dome_error = 0;    // both curvatures alike
    double saddle_error = 0;  // of opposite sign
    std::string text;  // what is wrong and what helps; empty where no error is above 5 %
    double worst() const;  // of largest magnitude
};

// For bricks with these edges in that many layers along the thickness axis (0, 1, 2).
// Throws std::invalid_argument on edges or a number of layers that are not positive.
ElementAdvice element_advice(ElementVariant variant, const Vec3& edges_m,
                             int thickness_axis, int layers, const Material& material);

}  // namespace magfsi::structure
