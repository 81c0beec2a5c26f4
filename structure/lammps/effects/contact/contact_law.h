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

// Coulomb's friction between two nodes that press each other with N and move past each
// other with v, across the line between them:
//   F = -min(mu N / |v|, c) v,   c = min(m_i, m_j) / (4 dt) share,
// share = 6 A / (pi d^2) / max(2.2, 6 A / (pi d^2)) of the larger area A, so that the
// drags of all nodes that a node touches add up to at most about m / (4 dt): stable in
// every step dt. Where c v is less than mu N the surfaces stick but for a creep, of
// F / c: some ten steps' fall under weight where all of a surface touches, thousands in
// light contact, where few nodes do. The pair's momentum is conserved; its angular
// momentum but for F r, r < d the gap of the layer.
Vec3 friction_force_n(const ContactLaw& law, double normal_n, double drag_kg_s,
                      const Vec3& past_m_s);
double friction_drag_kg_s(const ContactLaw& law, double area_m2, double mass_kg,
                          double dt_s);

// 0.75 of the longest diagonal of a quadrilateral of the surface: a node in the middle of
// four others is half a diagonal away from them and feels them all.
double contact_distance_m(const std::vector<Body>& bodies);

// (lambda + 2 G) / (4 d) of the softest material: surfaces pass through each other under
// a pressure of 0.22 (lambda + 2 G), five shear moduli where lambda is 20 G.
double contact_stiffness_pa_m(const std::vector<Body>& bodies, double distance_m);

// Stiffness [Pa/m], for step_limit_s, that a surface feels at worst where it meets
// another of the same kind: 2.2 s (two surfaces at g = d / sqrt(e)) or, on a mesh coarser
// than d, that of the one node opposite, 6 s A_j / (pi d^2); both surfaces move, which
// doubles it.
double contact_spring_pa_m(const Body& body, const ContactLaw& law);

// The contact of the input with its missing values put in: contact_distance_m and
// contact_stiffness_pa_m of all bodies.
ContactLaw contact_law(const LammpsInput& input);

}  // namespace magfsi::structure
