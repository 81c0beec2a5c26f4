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
