#include "structure/lattice/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/lattice/hexahedron.h"
#include "structure/materials.h"

namespace magfsi::structure {
namespace {

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
            throw std::invalid_argument(
                fmt::format("element {} names node {}, but the mesh has nodes 0 to {}",
                            number, node, node_count - 1));
        }
    }
}

void check_material(const Material& material) {
    if (!(material.shear_modulus_pa > 0) || !(material.lame_lambda_pa > 0)) {
        throw std::invalid_argument(
            fmt::format("G = {:g} Pa and K = {:g} Pa found, both must be positive",
                        material.shear_modulus_pa, material.lame_lambda_pa));
    }
}

// Volumes first and density last, material by material: the rounding of a body of one
// material does not depend on how many there could be.
class NodeMasses {
  public:
    NodeMasses(const std::vector<Material>& materials, std::size_t nodes)
        : materials_(materials),
          volume_(materials.size(), std::vector<double>(nodes, 0.0)) {}

    void add(std::size_t material, int node, double volume_m3) {
        volume_[material][static_cast<std::size_t>(node)] += volume_m3;
    }
    std::vector<double> masses_kg() const {
        std::vector<double> out(volume_.front().size(), 0.0);
        for (std::size_t m = 0; m < volume_.size(); ++m) {
            for (std::size_t n = 0; n < out.size(); ++n) {
                out[n] += volume_[m][n] * materials_[m].density_kg_m3;
            }
        }
        return out;
    }

  private:
    const std::vector<Material>& materials_;
    std::vector<std::vector<double>> volume_;
};

}  // namespace

Lattice build_lattice(const Body& body) {
    return build_lattice(body.mesh.nodes, body.mesh.elements, all_materials(body),
                         body.element_material, body.element);
}

Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements, const Material& material,
                      ElementVariant variant) {
    return build_lattice(nodes_m, elements, std::vector<Material>{material}, {}, variant);
}

Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements,
                      const std::vector<Material>& materials,
                      const std::vector<int>& element_material, ElementVariant variant) {
    check_materials(element_material, elements.size(), materials.size() - 1);
    for (const Material& material : materials) check_material(material);
    Lattice out;
    out.materials = materials;
    out.element_material = element_material;
    out.variant = variant;
    out.elements = elements;
    out.modes.reserve(elements.size());
    out.node_volume_m3.assign(nodes_m.size(), 0.0);
    NodeMasses masses(out.materials, nodes_m.size());
    out.bricks = true;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const int number = static_cast<int>(e);
        check_nodes(elements[e], number, nodes_m.size());
        const Positions8 x = gather(nodes_m, elements[e]);
        const ElementReference reference = element_reference(x, variant, number);
        const auto material =
            static_cast<std::size_t>(element_material.empty() ? 0 : element_material[e]);
        out.modes.push_back(
            element_modes(reference, materials[material].shear_modulus_pa));
        out.bricks = out.bricks && out.modes.back().brick;
        out.longest_diagonal_m = std::max(out.longest_diagonal_m, longest_diagonal(x));
        for (int a = 0; a < 8; ++a) {
            out.node_volume_m3[elements[e][a]] += reference.node_volume[a];
            masses.add(material, elements[e][a], reference.node_volume[a]);
        }
    }
    out.node_mass_kg = masses.masses_kg();
    if (variant == ElementVariant::mean_f) refuse_soft_bending(nodes_m, elements);
    return out;
}

}  // namespace magfsi::structure
