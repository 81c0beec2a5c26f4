// SPDX-License-Identifier: GPL-2.0-or-later
// The lattice of one body: its elements' reference states, ready for the kernels.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/lattice/element.h"

namespace magfsi::structure {

// An element's reference state in Hadamard mode space. With x_a = sum_m h_m(a) u_m the
// force on mode n is -sum_m spring[nm] u_m; mode 0, the translation, drops out and a
// symmetric 7x7 remains, diagonal for bricks.
struct ElementModes {
    std::array<double, 28> spring{};    // G/8 H^T L H, upper triangle row by row [N/m]
    std::array<double, 21> gradient{};  // sum_a h_m(a) b_a / V0, three per mode [1/m]
    // Inverse metrics of HourglassReference (11, 22, 12 of each group) [1/m2] and its
    // vectors X_j of the modes xy, xz, yz, xyz, three values per mode [m].
    std::array<double, 9> metric{};
    std::array<double, 12> offset{};
    double volume = 0;   // [m3]
    bool brick = false;  // spring is diagonal, gradient that of a brick
};

// Positions of the seven diagonal entries within ElementModes::spring.
inline constexpr std::array<int, 7> diagonal_entries{0, 7, 13, 18, 22, 25, 27};

// Positions within ElementModes::metric of the inverse squares of a brick's half edges
// along x, y, z.
inline constexpr std::array<int, 3> brick_metric_entries{3, 0, 1};

struct Lattice {
    std::vector<Material> materials;    // at least one
    std::vector<int> element_material;  // index into materials; empty: all of the first
    ElementVariant variant = ElementVariant::full;
    std::vector<Hexahedron> elements;
    std::vector<ElementModes> modes;  // one per element
    std::vector<double> node_volume_m3;
    // Integral of density times the node's shape functions, or as Body::inertia says; a
    // node between two materials has mass of both.
    std::vector<double> node_mass_kg;
    double longest_diagonal_m = 0;  // largest distance between two nodes of one element
    bool bricks = false;            // every element is a brick
};

// Throws std::invalid_argument, naming the element, on an inverted element, a node number
// out of range, an unknown material, or an element mean_f that bends too softly.
Lattice build_lattice(const Body& body);
Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements,
                      const std::vector<Material>& materials,
                      const std::vector<int>& element_material, ElementVariant variant);

// Some elements of one material: the kernels take the constants of one at a time.
struct MaterialPart {
    Material material;
    std::vector<int> elements;  // of the lattice, in the order given
    std::vector<std::array<int, 8>> nodes;
};

// In the order of the lattice's materials, those without an element left out; nodes: the
// eight indices of each of the elements.
std::vector<MaterialPart> material_parts(const Lattice& lattice,
                                         std::span<const int> elements,
                                         std::span<const std::array<int, 8>> nodes);

}  // namespace magfsi::structure
