// SPDX-License-Identifier: GPL-2.0-or-later
// Law of contact between surfaces, of two bodies or of a body with itself: springs
// between pairs of surface nodes.
#pragma once

#include <vector>

#include "structure/lammps/script.h"

namespace magfsi::structure {

// Normal contact of one pair of nodes.
struct ContactForce {
    double force_n = 0;  // repulsive, along the line between the nodes
    double energy_j = 0;
};

// Energy and force of two nodes with the areas A_i and A_j [m2] at the distance r < d:
//   W = (3 s / (pi d^2)) A_i A_j (d - r)^2.
// Summed over two flat surfaces at the gap g this gives the pressure 6 s g (d - g)^2 /
// d^2, whatever the mesh, and the energy s d^2 / 2 per area to bring them from d to 0, as
// for the linear law s (d - g). The largest pressure, 0.89 s d, is at g = d / 3. There is
// no force at r = 0, where it has no direction. areas_m4: A_i A_j.
ContactForce contact_force(const ContactLaw& law, double areas_m4, double distance_m);

// Memory of friction in a pair of nodes: their difference of place when they stuck to
// each other, dragged along since.
struct StuckPair {
    // x_i - x_j when they stuck
    Vec3 apart_m{};
    // Part of apart_m across the line between them, at the last evaluation
    double slip_m = 0;
    // True while they touch
    bool held = false;
};

// Friction of one pair of nodes.
struct PairFriction {
    Vec3 force_n{};     // on the first node; the second has the opposite
    double lost_j = 0;  // energy lost by sliding or letting go since the last evaluation
};

// Coulomb friction between two nodes by a tangential spring with a memory (Cundall and
// Strack, Geotechnique 29, 1979). apart_m = x_i - x_j has the length r and the direction
// n; s is its value when the nodes stuck, s_t the part of s across n:
//   W = k s_t^2 / 2,  F_i = -dW/dx_i = k (s.n / r) s_t,  |F_i| <= mu k (d - r),
// with the k of contact_force, so that the pair is as stiff across as along. If the force
// would be larger, s is dragged along. Its part across n becomes what the limit allows.
// Its part along n is at least r, or the force would fade; a longer one stays as it is,
// or the spring would gain energy. The force depends on the positions alone, so that a
// second evaluation at the same positions changes nothing. The energy lost is the work of
// the mean force between two evaluations less the gain of the spring; it is never
// negative. The pair's momentum is conserved; its angular momentum only up to F r, where
// r < d is the gap of the layer.
PairFriction pair_friction(const ContactLaw& law, double areas_m4, const Vec3& apart_m,
                           StuckPair& stuck);
// Energy of the tangential spring at the last evaluation [J].
double stuck_energy_j(const ContactLaw& law, double areas_m4, const StuckPair& stuck);

// Default distance [m]: 0.75 of the longest diagonal of a quad of the surfaces. A node in
// the middle of four others is half a diagonal away from them and thus feels all four.
double contact_distance_m(const std::vector<Body>& bodies);

// Default stiffness [Pa/m]: (lambda + 2 G) / (4 d) of the softest material. Surfaces pass
// through each other under a pressure of 0.22 (lambda + 2 G), which is five shear moduli
// for lambda = 20 G. Throws std::invalid_argument without a body or on a distance that is
// not positive.
double contact_stiffness_pa_m(const std::vector<Body>& bodies, double distance_m);

// Stiffness [Pa/m] that a surface feels at worst from another of the same kind, for
// step_limit_s: 2.2 s (two surfaces at g = d / sqrt(e)) or, on a mesh coarser than d,
// that of the one node opposite, 6 s A_j / (pi d^2). Both surfaces move, which doubles
// it. With friction a pair is as stiff across as along: 5.4 s, the sum of all k over a
// flat surface at the gap d / 3 of the largest pressure, 6 s (1 - g^2 / d^2).
double contact_spring_pa_m(const Body& body, const ContactLaw& law);

// Contact law of the input with missing values filled in: contact_distance_m and
// contact_stiffness_pa_m of all bodies. input.contact must be set.
ContactLaw contact_law(const LammpsInput& input);

}  // namespace magfsi::structure
