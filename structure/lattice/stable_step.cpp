#include "structure/lattice/stable_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/lattice/rest_stiffness.h"
#include "structure/lattice/viscous_element.h"
#include "structure/materials.h"

namespace magfsi::structure {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

double largest_over_mass(const Matrix24& matrix, const Vector24& inverse_root_mass) {
    const Matrix24 scaled =
        inverse_root_mass.asDiagonal() * matrix * inverse_root_mass.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix24> solver(scaled, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()(23);
}

double element_step_s(const Positions8& x, ElementVariant variant,
                      const Material& material, int number) {
    const ElementReference reference = element_reference(x, variant, number);
    Vector24 inverse_root_mass;
    for (int q = 0; q < 24; ++q) {
        const double mass = material.density_kg_m3 * reference.node_volume[q / 3];
        inverse_root_mass(q) = 1 / std::sqrt(mass);
    }
    const double omega = std::sqrt(
        largest_over_mass(stiffness_at_rest(reference, material, x), inverse_root_mass));
    if (material.viscosity_pa_s == 0) return 2 / omega;
    const double damping = largest_over_mass(
        viscous_damping_at_rest(reference, material, x), inverse_root_mass);
    const double z = damping / (2 * omega);
    return 2 / (omega * (std::sqrt(1 + z * z) + z));
}

void check(const Body& body, const Material& material) {
    if (!(material.density_kg_m3 > 0)) {
        throw std::invalid_argument(
            fmt::format("body {} has an effective density of {:g} kg/m3, it must be "
                        "positive (explicit "
                        "steps cannot carry a body that is lighter than its fluid)",
                        body.name, material.density_kg_m3));
    }
    if (!(material.viscosity_pa_s >= 0)) {
        throw std::invalid_argument(fmt::format(
            "body {} has a viscosity of {:g} Pa s, it must be zero or positive",
            body.name, material.viscosity_pa_s));
    }
}

}  // namespace

double stable_step_s(const Body& body) {
    check_materials(body.element_material, body.mesh.elements.size(),
                    body.other_materials.size());
    for (const Material& material : used_materials(body)) check(body, material);
    double smallest = INFINITY;
    Positions8 solved = Positions8::Zero();  // shape of the element solved last
    const Material* of = nullptr;            // and its material
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        Positions8 x = gather(body.mesh.nodes, body.mesh.elements[e]);
        x.rowwise() -= x.row(0).eval();
        const Material& material = material_of(body, e);
        // Neighbours of one shape, as in a block of bricks, need only one solution.
        if (of == &material && (x - solved).norm() <= 1e-9 * x.norm()) continue;
        solved = x;
        of = &material;
        smallest = std::min(
            smallest, element_step_s(x, body.element, material, static_cast<int>(e)));
    }
    return smallest;
}

double stable_elastic_step_s(Body body) {
    body.material.viscosity_pa_s = 0;
    for (Material& material : body.other_materials) material.viscosity_pa_s = 0;
    return stable_step_s(body);
}

}  // namespace magfsi::structure
