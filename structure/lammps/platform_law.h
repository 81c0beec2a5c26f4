// SPDX-License-Identifier: GPL-2.0-or-later
// Platform that pushes nodes back: its stiffness, and penalty pressure and Coulomb
// friction on one node.
#pragma once

#include <span>

#include "structure/lammps/script.h"

namespace magfsi::structure {

// Point of the plane to which a node's tangential spring is attached. It is released when
// the node lifts off and set anew at the next touch.
struct StickPoint {
    Vec3 at_m{};
    bool held = false;
};

// Forces and energies of one node.
struct PlatformContact {
    double gap_m = 0;     // along the normal; negative: penetration
    double normal_n = 0;  // normal force, never negative, as the plane does not pull
    Vec3 force_n{};       // force on the node, friction included
    double energy_j = 0;  // energy of the normal and the tangential spring
    double slid_j = 0;    // energy that sliding has dissipated in this evaluation
};

// Contact of one node with the surface area A [m2]. The normal force is A (stiffness *
// penetration - damping * v.n). Friction is the tangential spring of Cundall and Strack
// (Geotechnique 29, 1979), of the same stiffness, with its force limited to mu times the
// normal force: beyond that the stick point is dragged along. The force depends on the
// stick point and the position alone, so that a second evaluation at the same position
// changes nothing (restarts, setups, minimisers). A node that touches in a step of dt_s
// sticks where it passed through the plane, so that one that slides fast has its full
// friction at once; with dt_s = 0 it sticks at its present position.
PlatformContact platform_contact(const Platform& platform, double area_m2,
                                 const double* x_m, const double* v_m_s, double dt_s,
                                 StickPoint& stick);

// Contact of one node without friction.
PlatformContact frictionless_contact(const Platform& platform, double area_m2,
                                     const double* x_m, const double* v_m_s);

// Default stiffness of a platform [Pa/m]: (lambda + 2 G) / (2 thickness), half of that of
// a layer of the material under a rigid plate. The penetration under a pressure p is 2 p
// / (lambda + 2 G) of the thickness, below 1 % up to p = (lambda + 2 G) / 200 (0.11 G for
// lambda = 20 G). Weight (rho g h, 1e-4 G for a soft sheet) and field (|M| |B|, a few
// hundredths of G) stay below. Throws std::invalid_argument on a thickness that is not
// positive.
double platform_stiffness_pa_m(const Material& material, double thickness_m);

// The platform with its stiffness filled in if it is 0: the largest
// platform_stiffness_pa_m of the bodies' materials, with the smallest extent of each mesh
// as the thickness.
Platform with_stiffness(const Platform& platform, std::span<const Body> bodies);

}  // namespace magfsi::structure
