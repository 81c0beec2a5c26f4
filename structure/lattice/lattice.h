// The lattice of one body: its elements' reference states, ready for the kernel.
#pragma once

#include <vector>

#include "structure/body.h"
#include "structure/lattice/element_modes.h"

namespace magfsi::structure {

struct Lattice {
    std::vector<Material> materials;    // at least one
    std::vector<int> element_material;  // place in materials; empty: all of the first
    ElementVariant variant = ElementVariant::full;
    std::vector<Hexahedron> elements;
    std::vector<ElementModes> modes;  // one an element
    std::vector<double> node_volume_m3;
    std::vector<double> node_mass_kg;  // a node between two materials has of both
    double longest_diagonal_m = 0;  // largest distance between two nodes of one element
    bool bricks = false;            // every element is a brick
};

// Throws std::invalid_argument, naming the element, on an inverted element, a node number
// out of range, a material that there is not, or a mean_f element that bends too softly
// (refuse_soft_bending).
Lattice build_lattice(const Body& body);
Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements,
                      const std::vector<Material>& materials,
                      const std::vector<int>& element_material, ElementVariant variant);
// Of one material.
Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements, const Material& material,
                      ElementVariant variant);

// Mass of each node [kg]: the integral of density times its shape functions.
inline std::vector<double> node_masses(const Lattice& lattice) {
    return lattice.node_mass_kg;
}

// mean_f takes the bending stiffness from 3 min(l_i, l_j)^2, which is that of the
// thickness only where the thickness edge is the shortest one; with a shorter in-plane
// edge a plate bends up to four times too easily. The thickness is the direction of the
// body's smallest extent; in-plane edges down to 0.9 of it are accepted. Throws
// std::invalid_argument naming the element and its edges.
void refuse_soft_bending(const std::vector<Vec3>& nodes_m,
                         const std::vector<Hexahedron>& elements);

}  // namespace magfsi::structure
