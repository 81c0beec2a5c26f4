#include "structure/lattice/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/lattice/hexahedron.h"

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

}  // namespace

Lattice build_lattice(const std::vector<Vec3>& nodes_m,
                      const std::vector<Hexahedron>& elements, const Material& material,
                      ElementVariant variant) {
    check_material(material);
    Lattice out;
    out.material = material;
    out.variant = variant;
    out.elements = elements;
    out.modes.reserve(elements.size());
    out.node_volume_m3.assign(nodes_m.size(), 0.0);
    out.bricks = true;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const int number = static_cast<int>(e);
        check_nodes(elements[e], number, nodes_m.size());
        const Positions8 x = gather(nodes_m, elements[e]);
        const ElementReference reference = element_reference(x, variant, number);
        out.modes.push_back(element_modes(reference, material.shear_modulus_pa));
        out.bricks = out.bricks && out.modes.back().brick;
        out.longest_diagonal_m = std::max(out.longest_diagonal_m, longest_diagonal(x));
        for (int a = 0; a < 8; ++a) {
            out.node_volume_m3[elements[e][a]] += reference.node_volume[a];
        }
    }
    if (variant == ElementVariant::mean_f) refuse_soft_bending(nodes_m, elements);
    return out;
}

std::vector<double> node_masses(const Lattice& lattice) {
    std::vector<double> masses(lattice.node_volume_m3);
    for (double& mass : masses) mass *= lattice.material.density_kg_m3;
    return masses;
}

}  // namespace magfsi::structure
