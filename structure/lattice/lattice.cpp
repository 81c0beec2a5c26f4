// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/lattice.h"

#include <algorithm>
#include <cmath>

#include "structure/lattice/inertia.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Largest ratio of other entries to the largest one in a brick's matrices. Rounding
// leaves about 1e-16; a mesh that is meant to be distorted has far more than this.
constexpr double brick_tolerance = 1e-12;

// In a brick only the linear modes x, y, z have a mean gradient.
bool gradient_of_brick(const std::array<double, 21>& gradient) {
    double largest = 0;
    double other = 0;
    for (int m = 1; m < 8; ++m) {
        const bool linear = m == 1 || m == 2 || m == 4;
        for (int d = 0; d < 3; ++d) {
            double& slot = linear ? largest : other;
            slot = std::max(slot, std::abs(gradient[3 * (m - 1) + d]));
        }
    }
    return other <= brick_tolerance * largest;
}

// Transforms the reference state to Hadamard modes and detects bricks.
ElementModes element_modes(const ElementReference& reference, double shear_modulus_pa) {
    Matrix8 h;
    for (int a = 0; a < 8; ++a) {
        for (int m = 0; m < 8; ++m) h(a, m) = mode_sign(m, a);
    }
    ElementModes out;
    out.volume = reference.volume;
    const Matrix8 spring =
        h.transpose() * reference.spring_matrix * h * (shear_modulus_pa / 8);
    const Positions8 gradient = h.transpose() * reference.gradient / reference.volume;
    const double scale = spring.diagonal().maxCoeff();
    out.brick = true;
    int k = 0;
    for (int m = 1; m < 8; ++m) {
        for (int n = m; n < 8; ++n) {
            out.spring[k++] = spring(m, n);
            if (n != m && std::abs(spring(m, n)) > brick_tolerance * scale) {
                out.brick = false;
            }
        }
        for (int d = 0; d < 3; ++d) out.gradient[3 * (m - 1) + d] = gradient(m, d);
    }
    out.brick = out.brick && gradient_of_brick(out.gradient);
    for (int d = 0; d < 3; ++d) {
        const Eigen::Matrix2d& metric = reference.hourglass.metric[d];
        out.metric[3 * d] = metric(0, 0);
        out.metric[3 * d + 1] = metric(1, 1);
        out.metric[3 * d + 2] = metric(0, 1);
        for (int j = 0; j < 4; ++j) {
            out.offset[3 * j + d] = reference.hourglass.offset_m(j, d);
        }
    }
    return out;
}

double longest_diagonal(const Positions8& x) {
    double longest = 0;
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < a; ++b) {
            longest = std::max(longest, (x.row(a) - x.row(b)).norm());
        }
    }
    return longest;
}

void check_nodes(const Hexahedron& element, int number, std::size_t node_count) {
    for (int node : element) {
        if (node < 0 || static_cast<std::size_t>(node) >= node_count) {
            refuse("element {} names node {}, but the mesh has nodes 0 to {}", number,
                   node, node_count - 1);
        }
    }
}

void check_material(const Material& material) {
    if (!(material.shear_modulus_pa > 0) || !(material.lame_lambda_pa >= 0)) {
        refuse(
            "material with G = {:g} Pa and K = {:g} Pa found, G must be positive and K "
            "not negative",
            material.shear_modulus_pa, material.lame_lambda_pa);
    }
}

// Checks the materials of soft elements; rigid ones need no modulus.
void check_moduli(const std::vector<Material>& materials,
                  const std::vector<int>& element_material,
                  const std::vector<int>& element_rigid) {
    std::vector<bool> soft(materials.size(), element_rigid.empty());
    for (std::size_t e = 0; e < element_rigid.size(); ++e) {
        if (element_rigid[e] < 0)
            soft[element_material.empty() ? 0 : element_material[e]] = true;
    }
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (soft[m]) check_material(materials[m]);
}

}  // namespace

Lattice build_lattice(const Body& body) {
    Lattice out = build_lattice(body.mesh.nodes, body.mesh.elements, all_materials(body),
                                body.element_material, body.element, body.element_rigid);
    if (body.inertia == Inertia::lumped) return out;
    std::ranges::fill(out.node_mass_kg, 0.0);
    const auto masses = element_masses_kg(body);
    for (std::size_t e = 0; e < masses.size(); ++e) {
        for (std::size_t a = 0; a < 8; ++a)
            out.node_mass_kg[out.elements[e][a]] += masses[e][a];
    }
    return out;
}

Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements,
                      const std::vector<Material>& materials,
                      const std::vector<int>& element_material, ElementVariant variant,
                      const std::vector<int>& element_rigid) {
    check_materials(element_material, elements.size(), materials.size() - 1);
    check_moduli(materials, element_material, element_rigid);
    Lattice out;
    out.materials = materials;
    out.element_material = element_material;
    out.element_rigid = element_rigid;
    out.variant = variant;
    out.elements = elements;
    out.modes.reserve(elements.size());
    out.node_volume_m3.assign(nodes_m.size(), 0.0);
    out.node_mass_kg.assign(nodes_m.size(), 0.0);
    // Volumes are summed by material and multiplied by the density at the end, so that
    // the rounding of a body of one material does not depend on how many materials there
    // are.
    std::vector volume_m3(materials.size(), out.node_volume_m3);
    out.bricks = true;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const int number = e;
        check_nodes(elements[e], number, nodes_m.size());
        const Positions8 x = gather(nodes_m, elements[e]);
        const ElementReference reference = element_reference(x, variant, number);
        const int material = element_material.empty() ? 0 : element_material[e];
        out.modes.push_back(
            element_modes(reference, materials[material].shear_modulus_pa));
        out.bricks = out.bricks && out.modes.back().brick;
        out.longest_diagonal_m = std::max(out.longest_diagonal_m, longest_diagonal(x));
        for (int a = 0; a < 8; ++a) {
            out.node_volume_m3[elements[e][a]] += reference.node_volume[a];
            volume_m3[material][elements[e][a]] += reference.node_volume[a];
        }
    }
    for (std::size_t m = 0; m < materials.size(); ++m) {
        for (std::size_t n = 0; n < nodes_m.size(); ++n) {
            out.node_mass_kg[n] += volume_m3[m][n] * materials[m].density_kg_m3;
        }
    }
    return out;
}

std::vector<MaterialPart> material_parts(const Lattice& lattice,
                                         std::span<const int> elements,
                                         std::span<const std::array<int, 8>> nodes) {
    std::vector<MaterialPart> out(lattice.materials.size());
    for (std::size_t m = 0; m < out.size(); ++m) out[m].material = lattice.materials[m];
    for (std::size_t i = 0; i < elements.size(); ++i) {
        MaterialPart& part =
            out[lattice.element_material.empty() ? 0
                                                 : lattice.element_material[elements[i]]];
        part.elements.push_back(elements[i]);
        part.nodes.push_back(nodes[i]);
    }
    std::erase_if(out, [](const MaterialPart& part) { return part.elements.empty(); });
    return out;
}

}  // namespace magfsi::structure
