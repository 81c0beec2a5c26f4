// SPDX-License-Identifier: GPL-2.0-or-later
// The lattice of one body: its elements' reference states, ready for the kernels.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/lattice/element.h"

namespace magfsi::structure {

// Reference state of an element in Hadamard mode space. With x_a = sum_m h_m(a) u_m the
// force on mode n is -sum_m spring[nm] u_m. Mode 0, the translation, has no force, so
// that a symmetric 7x7 matrix remains; it is diagonal for bricks.
struct ElementModes {
    std::array<double, 28> spring{};    // G/8 H^T L H, upper triangle row by row [N/m]
    std::array<double, 21> gradient{};  // sum_a h_m(a) b_a / V0, three per mode [1/m]
    // metric: inverse metrics of HourglassReference, 11, 22 and 12 of each group [1/m2].
    // offset: its vectors X_j of the modes xy, xz, yz, xyz, three values each [m].
    std::array<double, 9> metric{};
    std::array<double, 12> offset{};
    double volume = 0;   // [m3]
    bool brick = false;  // spring is diagonal and gradient that of a brick
};

// Indices of the seven diagonal entries in ElementModes::spring.
inline constexpr std::array<int, 7> diagonal_entries{0, 7, 13, 18, 22, 25, 27};

// Indices in ElementModes::metric of the inverse squares of a brick's half edges along x,
// y, z.
inline constexpr std::array<int, 3> brick_metric_entries{3, 0, 1};

// All elements of a body, with the volumes and masses of its nodes.
struct Lattice {
    std::vector<Material> materials;    // at least one
    std::vector<int> element_material;  // index into materials; empty: all 0
    // Number of each element's rigid part, -1 if it is soft; empty: all are soft
    std::vector<int> element_rigid;
    ElementVariant variant = ElementVariant::full;
    std::vector<Hexahedron> elements;
    std::vector<ElementModes> modes;  // one per element
    // Share of each node, the integral of its shape functions
    std::vector<double> node_volume_m3;
    // Mass of each node: integral of density times its shape functions, corrected as
    // Body::inertia says. A node between two materials has mass of both.
    std::vector<double> node_mass_kg;
    double longest_diagonal_m = 0;  // largest distance between two nodes of one element
    bool bricks = false;            // every element is a brick
};

// Lattice of a body. Throws std::invalid_argument, with the element's number, on an
// inverted element, a node number out of range or an unknown material, and on moduli that
// are not allowed (a rigid element needs none). The second form has lumped masses.
Lattice build_lattice(const Body& body);
Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements,
                      const std::vector<Material>& materials,
                      const std::vector<int>& element_material, ElementVariant variant,
                      const std::vector<int>& element_rigid = {});

// Elements of one material, as a kernel takes the constants of one material at a time.
struct MaterialPart {
    Material material;
    std::vector<int> elements;              // numbers in the lattice, in the given order
    std::vector<std::array<int, 8>> nodes;  // indices of the nodes of each
};

// Splits elements by material, in the order of the lattice's materials; materials without
// an element are left out. nodes: the eight node indices of each element.
std::vector<MaterialPart> material_parts(const Lattice& lattice,
                                         std::span<const int> elements,
                                         std::span<const std::array<int, 8>> nodes);

}  // namespace magfsi::structure
