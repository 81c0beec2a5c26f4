// SPDX-License-Identifier: GPL-2.0-or-later
// Effect of the choice of elements on a plate's stiffness, computed before a run.
#pragma once

#include <Eigen/Core>
#include <string>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// Stiffness D [N m] of a plate with the energy 1/2 k^T D k per area, where k = (k_pp,
// k_qq, k_pq) are the curvatures along the in-plane axes p, q, which follow the thickness
// axis in the order x, y, z, x.
using PlateStiffness = Eigen::Matrix3d;

// Kirchhoff plate of thickness T: T^3 / 12 [[2 G + l, l, 0], [l, 2 G + l, 0], [0, 0, 4
// G]] with l = 2 G K / (K + 2 G) of plane stress.
PlateStiffness kirchhoff_plate(const Material& material, double thickness_m);

// Infinite plate of `layers` equal layers, each an infinite repetition of one element (a
// prism between two planes normal to the thickness axis). Its nodes follow the curvature,
// u_p = -(k_pp p + k_pq q) z, u_q = -(k_pq p + k_qq q) z, u_z = k_pp p^2 / 2 + k_qq q^2 /
// 2 + k_pq p q, plus a displacement of each level, the same for all of its nodes, that
// minimises the energy. Linear in the curvature. Throws std::invalid_argument on a number
// of layers that is not positive or on an inverted element.
PlateStiffness lattice_plate(ElementVariant variant, const Positions8& layer_m,
                             int thickness_axis, int layers, const Material& material);

// Relative errors of the mesh's stiffness in small deformation: found over exact, less 1,
// so that negative is too soft. If a mode has two directions, the worse one counts.
struct ElementAdvice {
    double bending_error = 0;  // for plates and narrow beams, about both in-plane axes
    double twist_error = 0;
    double dome_error = 0;    // both curvatures equal
    double saddle_error = 0;  // curvatures of opposite sign
    // Faults and remedy in words; empty if no error is above 5 %
    std::string text;
    double worst() const;  // the error of largest magnitude
};

// Advice for bricks with these edges, in `layers` layers along the thickness axis (0, 1,
// 2). Throws std::invalid_argument on edges or a number of layers that are not positive.
ElementAdvice element_advice(ElementVariant variant, const Vec3& edges_m,
                             int thickness_axis, int layers, const Material& material);

}  // namespace magfsi::structure
