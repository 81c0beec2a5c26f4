#include "structure/lattice/current_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "structure/lattice/element_energy.h"
#include "structure/materials.h"

namespace magfsi::structure {

namespace {

Positions8 positions(std::span<const Vec3> nodes_m, const Hexahedron& element) {
    Positions8 x;
    for (int a = 0; a < 8; ++a) {
        const Vec3& node = nodes_m[static_cast<std::size_t>(element[a])];
        for (int d = 0; d < 3; ++d) x(a, d) = node[static_cast<std::size_t>(d)];
    }
    x.rowwise() -= x.row(0).eval();
    return x;
}

}  // namespace

CurrentStep::CurrentStep(const Body& body) {
    elements_.reserve(body.mesh.elements.size());
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        const Material& material = material_of(body, e);
        Element& element = elements_.emplace_back();
        element.nodes = body.mesh.elements[e];
        const Positions8 x = positions(body.mesh.nodes, element.nodes);
        const auto reference = element_reference(x, body.element, static_cast<int>(e));
        element.exact = body.element == ElementVariant::full;
        element.gradient_m2 = reference.gradient;
        element.volume_m3 = reference.volume;
        for (std::size_t a = 0; a < 8; ++a) {
            element.inverse_mass[a] =
                1 / (material.density_kg_m3 * reference.node_volume[a]);
        }
        element.lame_pa = material.lame_lambda_pa;
        element.shear_pa = material.shear_modulus_pa;
        element.at_rest_1_s2 = volume_term_1_s2(element, x);
    }
}

double CurrentStep::volume_term_1_s2(const Element& element, const Positions8& x_m) {
    const VolumeAndGradient now =
        element.exact ? exact_volume(x_m)
                      : mean_volume(x_m, element.gradient_m2, element.volume_m3);
    const double j = now.volume_m3 / element.volume_m3;
    if (!(j > 0)) return std::numeric_limits<double>::infinity();
    double slope = 0;
    for (int a = 0; a < 8; ++a) {
        slope += now.gradient_m2.row(a).squaredNorm() *
                 element.inverse_mass[static_cast<std::size_t>(a)];
    }
    const double modulus =
        (element.lame_pa * (1 - std::log(j)) + element.shear_pa) / (j * j);
    return modulus / element.volume_m3 * slope;
}

double CurrentStep::rise_1_s2(std::span<const Vec3> nodes_m) const {
    double largest = 0;
    for (const Element& element : elements_) {
        const Positions8 x = positions(nodes_m, element.nodes);
        largest = std::max(largest, volume_term_1_s2(element, x) - element.at_rest_1_s2);
    }
    return largest;
}

double CurrentStep::step_s(double step_at_rest_s, double rise_1_s2) {
    return 2 / std::sqrt(4 / (step_at_rest_s * step_at_rest_s) + rise_1_s2);
}

}  // namespace magfsi::structure
