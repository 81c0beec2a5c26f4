// Magnetic forces on the nodes of a lattice with fixed magnetisation.
#pragma once

#include <vector>

#include "structure/lattice/lattice.h"

namespace magfsi::structure {

// q_a = sum over elements of M_e . b_a(e) [A m], b_a = integral of grad N_a. In a uniform
// field B the energy -integral of (F M) . B gives the node the force q_a B, whatever the
// deformation. The sum over a body is zero. One value a node; zeros where the
// magnetisation (one vector an element [A/m]) is empty. Throws std::invalid_argument if
// the number of vectors is neither zero nor that of the elements.
std::vector<double> nodal_charges(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements,
                                  const std::vector<Vec3>& magnetization_a_m);

}  // namespace magfsi::structure
