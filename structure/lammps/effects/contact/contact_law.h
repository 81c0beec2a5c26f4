// SPDX-License-Identifier: GPL-2.0-or-later
// Contact between surfaces, of two bodies or of a body with itself: springs between the
// nodes of the surfaces.
#pragma once

#include <vector>

#include "structure/lammps/script.h"

namespace magfsi::structure {

struct ContactForce {
    double force_n = 0;  // repulsive, along the line between the nodes
    double energy_j = 0;
};

// Two nodes of areas A_i and A_j at the distance r < d:
//   W = (3 s / (pi d^2)) A_i A_j (d - r)^2.
// Summed over two flat surfaces at the distance g this is the pressure
// 6 s g (d - g)^2 / d^2, whatever the mesh, and takes the energy s d^2 / 2 an area to
// bring them from d to 0, that of the linear law s (d - g); its largest pressure, 0.89 s
// d, is reached at g = d / 3. No force at r = 0, where there is no direction.
ContactForce contact_force(const ContactLaw& law, double areas_m4, double distance_m);

// What a node has of another that it touches: where it was to it when they stuck to each
// other, dragged along since.
struct StuckPair {
    Vec3 apart_m{};
    double slip_m = 0;  // across the line between them, at the last look
    bool held = false;
};

struct PairFriction {
    Vec3 force_n{};     // on the first node; the opposite on the second
    double lost_j = 0;  // what dragging, or letting go, has cost since the last look
};

// Coulomb's friction between two nodes, by a tangential spring with a memory (Cundall and
// Strack, Geotechnique 29, 1979). apart_m = x_i - x_j, of the length r and the direction
// n; s is that of the time when they stuck, s_t its part across n:
//   W = k s_t^2 / 2,  F_i = -dW/dx_i = k (s.n / r) s_t,  |F_i| <= mu k (d - r),
// with k that of contact_force: as stiff across as along. Where the force would be
// larger, s is dragged along: as much across as it bears, along n at least r, or the
// force would fade, and not less where it was longer, or the spring would gain energy.
// The force depends on places alone: looking again changes nothing. What is lost is the
// work of the mean force of two looks less what the spring has gained, never negative.
// The pair's momentum is conserved; its angular momentum but for F r, r < d the gap of
// the layer.
PairFriction pair_friction(const ContactLaw& law, double areas_m4, const Vec3& apart_m,
                           StuckPair& stuck);
// Of the tangential spring, at the last look.
double stuck_energy_j(const ContactLaw& law, double areas_m4, const StuckPair& stuck);

// 0.75 of the longest diagonal of a quadrilateral of the surface: a node in the middle of
// four others is half a diagonal away from them and feels them all.
double contact_distance_m(const std::vector<Body>& bodies);

// (lambda + 2 G) / (4 d) of the softest material: surfaces pass through each other under
// a pressure of 0.22 (lambda + 2 G), five shear moduli where lambda is 20 G.
double contact_stiffness_pa_m(const std::vector<Body>& bodies, double distance_m);

// Stiffness [Pa/m], for step_limit_s, that a surface feels at worst where it meets
// another of the same kind: 2.2 s (two surfaces at g = d / sqrt(e)) or, on a mesh coarser
// than d, that of the one node opposite, 6 s A_j / (pi d^2); both surfaces move, which
// doubles it. With friction a pair is as stiff across as along: 5.4 s, the sum of all k
// over a flat surface at the gap d / 3 of the largest pressure, 6 s (1 - g^2 / d^2).
double contact_spring_pa_m(const Body& body, const ContactLaw& law);

// The contact of the input with its missing values put in: contact_distance_m and
// contact_stiffness_pa_m of all bodies.
ContactLaw contact_law(const LammpsInput& input);

}  // namespace magfsi::structure
