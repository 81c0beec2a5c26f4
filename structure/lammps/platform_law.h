// SPDX-License-Identifier: GPL-2.0-or-later
// A plane that pushes nodes back: its stiffness, and penalty pressure and Coulomb
// friction on one node.
#pragma once

#include <span>

#include "structure/lammps/script.h"

namespace magfsi::structure {

// Where a node sticks to the plane. One that has let go takes a new one when it touches.
struct StickPoint {
    Vec3 at_m{};
    bool held = false;
};

struct PlatformContact {
    double gap_m = 0;     // negative: penetration
    double normal_n = 0;  // never negative: the plane does not pull
    Vec3 force_n{};       // on the node, friction included
    double energy_j = 0;  // of the normal spring and the tangential one
    double slid_j = 0;    // what dragging the stick point has cost
};

// One node of area A [m2]: normal force A (stiffness * penetration - damping * v.n), and
// with friction the tangential spring of Cundall and Strack (Geotechnique 29, 1979), of
// the same stiffness, whose force is limited to mu times the normal force: where it would
// be larger, the stick point is dragged along. The force depends on the stick point and
// on the position alone, so that evaluating it again at one position changes nothing
// (restarts, setups, minimisers). A node that touches in a step of dt_s sticks where it
// went through the plane: one that slides fast has its full friction at once. dt_s = 0:
// it sticks where it is.
PlatformContact platform_contact(const Platform& platform, double area_m2,
                                 const double* x_m, const double* v_m_s, double dt_s,
                                 StickPoint& stick);

// The same without friction.
PlatformContact frictionless_contact(const Platform& platform, double area_m2,
                                     const double* x_m, const double* v_m_s);

// (lambda + 2 G) / (2 thickness): twice as soft as the material under a rigid plate. The
// penetration under the pressure p is 2 p / (lambda + 2 G) of the thickness, below 1 % up
// to p = (lambda + 2 G) / 200 (lambda = 20 G: 0.11 G). Weight (rho g h, 1e-4 G for a soft
// sheet) and field (|M| |B|, a few hundredths of G) stay below. Throws
// std::invalid_argument on a thickness that is not positive.
double platform_stiffness_pa_m(const Material& material, double thickness_m);

// With a missing stiffness put in: the largest
// platform_stiffness_pa_m of the bodies' materials (thickness: the mesh's smallest
// extent).
Platform with_stiffness(const Platform& platform, std::span<const Body> bodies);

}  // namespace magfsi::structure
