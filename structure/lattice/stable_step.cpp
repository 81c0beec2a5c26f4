// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/stable_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "structure/lattice/element.h"
#include "structure/lattice/inertia.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/rigid_mass.h"
#include "structure/mesh/surface.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

// Row 3 a + d is coordinate d of node a.
Vector24 flat(const Positions8& p) {
    Vector24 out;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) out(3 * a + d) = p(a, d);
    }
    return out;
}

// Second derivative d2V / dx dx. The gradient is quadratic in x, so that a central
// difference is exact.
Matrix24 volume_curvature(const ElementReference& reference, const Positions8& x) {
    const double h = std::cbrt(reference.volume);
    Matrix24 out;
    for (int q = 0; q < 24; ++q) {
        Positions8 plus = x;
        Positions8 minus = x;
        plus(q / 3, q % 3) += h;
        minus(q / 3, q % 3) -= h;
        const Positions8 change = element_volume(reference, plus).gradient_m2 -
                                  element_volume(reference, minus).gradient_m2;
        out.col(q) = flat(change) / (2 * h);
    }
    return out;
}

// Stiffness at J = 1 [N/m]: K_e = G L + (K + G) / V0 dV dV^T - G d2V + hourglass_tangent.
// It equals element_tangent there up to rounding, which would change the last digit of
// the time step, and with it that of every result.
Matrix24 stiffness_at_rest(const ElementReference& reference, const Material& material,
                           const Positions8& nodes_m) {
    const double g = material.shear_modulus_pa;
    const Vector24 slope = flat(element_volume(reference, nodes_m).gradient_m2);
    Matrix24 out =
        (material.lame_lambda_pa + g) / reference.volume * slope * slope.transpose() -
        g * volume_curvature(reference, nodes_m);
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
            for (int d = 0; d < 3; ++d) {
                out(3 * a + d, 3 * b + d) += g * reference.spring_matrix(a, b);
            }
        }
    }
    if (reference.variant == ElementVariant::assumed_strain) {
        out += hourglass_tangent(reference.hourglass, material, nodes_m);
    }
    return out;
}

// Largest eigenvalue of the matrix over the masses, M^-1/2 A M^-1/2.
double largest_over_mass(const Matrix24& matrix, const Vector24& inverse_root_mass) {
    const Matrix24 scaled =
        inverse_root_mass.asDiagonal() * matrix * inverse_root_mass.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix24> solver(scaled, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()(23);
}

double element_step_s(const Positions8& x, ElementVariant variant,
                      const Material& material, const std::array<double, 8>& masses_kg,
                      int number) {
    const ElementReference reference = element_reference(x, variant, number);
    Vector24 inverse_root_mass;
    for (int q = 0; q < 24; ++q) inverse_root_mass(q) = 1 / std::sqrt(masses_kg[q / 3]);
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
        refuse(
            "body {} has an effective density of {:g} kg/m3, it must be positive "
            "(explicit steps cannot carry a body that is lighter than its fluid): take a "
            "larger density of the material",
            body.name, material.density_kg_m3);
    }
    if (!(material.viscosity_pa_s >= 0)) {
        refuse("body {} has a viscosity of {:g} Pa s, it must be zero or positive",
               body.name, material.viscosity_pa_s);
    }
}

// Positions relative to the element's first node, which avoids a loss of digits far from
// the origin.
Positions8 local_positions(std::span<const Vec3> nodes_m, const Hexahedron& element) {
    Positions8 x = gather(nodes_m, element);
    x.rowwise() -= x.row(0).eval();
    return x;
}

// Elements that add no stiffness to nodes that can move: those whose nodes are all held
// along all axes, or all belong to one rigid part.
class Idle {
  public:
    explicit Idle(const Body& body)
        : held_(held_axes(body)), part_(rigid_part_of_nodes(body)) {}
    bool operator()(const Hexahedron& element) const {
        const auto fixed = [&](int node) {
            return held_[node] == HeldAxes{true, true, true};
        };
        const auto same = [&](int node) {
            return part_[node] >= 0 && part_[node] == part_[element[0]];
        };
        return std::ranges::all_of(element, fixed) ||
               (!part_.empty() && std::ranges::all_of(element, same));
    }

  private:
    std::vector<HeldAxes> held_;
    std::vector<int> part_;
};

// Largest stiffness over mass of springs on the surface [1/s2]: of a node, or of a rigid
// part as a whole.
double largest_spring_1_s2(const Body& body, double stiffness_pa_m) {
    auto spring_n_m = surface_areas(body.mesh.nodes, body.mesh.elements);
    for (double& k : spring_n_m) k *= stiffness_pa_m;
    const auto mass = build_lattice(body).node_mass_kg;
    const auto part = rigid_part_of_nodes(body);
    double largest = 0;
    for (std::size_t a = 0; a < mass.size(); ++a) {
        if (part.empty() || part[a] < 0)
            largest = std::max(largest, spring_n_m[a] / mass[a]);
    }
    for (std::size_t p = 0; p < body.rigid_parts.size(); ++p)
        largest = std::max(largest, rate_on_part(body, p, spring_n_m));
    return largest;
}

}  // namespace

double stable_step_s(const Body& body) {
    check_materials(body.element_material, body.mesh.elements.size(),
                    body.other_materials.size());
    for (const Material& material : used_materials(body)) check(body, material);
    double smallest = INFINITY;
    Positions8 solved = Positions8::Zero();  // shape of the element solved last
    const Material* of = nullptr;            // material of that element
    const auto masses_kg = element_masses_kg(body);
    std::size_t last = 0;
    const Idle is_idle(body);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        if (is_idle(body.mesh.elements[e])) continue;
        const Positions8 x = local_positions(body.mesh.nodes, body.mesh.elements[e]);
        const Material& material = material_of(body, e);
        // Elements of the same shape, as in a block of bricks, need only one solution.
        const bool alike =
            body.inertia == Inertia::lumped || masses_kg[e] == masses_kg[last];
        if (of == &material && alike && (x - solved).norm() <= 1e-9 * x.norm()) continue;
        solved = x;
        of = &material;
        last = e;
        smallest = std::min(smallest, element_step_s(x, body.element, material,
                                                     masses_kg[e], static_cast<int>(e)));
    }
    return smallest;
}

double stable_elastic_step_s(Body body) {
    body.material.viscosity_pa_s = 0;
    for (Material& material : body.other_materials) material.viscosity_pa_s = 0;
    return stable_step_s(body);
}

double step_limit_s(const Body& body, double stiffness_pa_m) {
    const double own = stable_step_s(body);
    const double largest = largest_spring_1_s2(body, stiffness_pa_m);
    if (std::isinf(own)) {  // no node can move, or none against another
        const bool moves = !body.rigid_parts.empty() && largest > 0;
        return moves ? 2 / std::sqrt(largest) : own;
    }
    const double frequency = 2 / stable_elastic_step_s(body);
    // The inverse of the relation that defines the body's own step.
    const double damping = 2 / own - 0.5 * own * frequency * frequency;
    const double squared = frequency * frequency + largest;
    return 4 / (std::sqrt(damping * damping + 4 * squared) + damping);
}

CurrentStep::CurrentStep(const Body& body) {
    elements_.reserve(body.mesh.elements.size());
    const auto masses_kg = element_masses_kg(body);
    const Idle is_idle(body);
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        if (is_idle(body.mesh.elements[e])) continue;
        const Material& material = material_of(body, e);
        Element& element = elements_.emplace_back();
        element.nodes = body.mesh.elements[e];
        const Positions8 x = local_positions(body.mesh.nodes, element.nodes);
        const auto reference = element_reference(x, body.element, static_cast<int>(e));
        element.exact = body.element == ElementVariant::full;
        element.gradient_m2 = reference.gradient;
        element.volume_m3 = reference.volume;
        for (std::size_t a = 0; a < 8; ++a) element.inverse_mass[a] = 1 / masses_kg[e][a];
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
    if (!(j > 0)) return INFINITY;
    double slope = 0;
    for (int a = 0; a < 8; ++a) {
        slope += now.gradient_m2.row(a).squaredNorm() * element.inverse_mass[a];
    }
    const double modulus =
        (element.lame_pa * (1 - std::log(j)) + element.shear_pa) / (j * j);
    return modulus / element.volume_m3 * slope;
}

double CurrentStep::rise_1_s2(std::span<const Vec3> nodes_m) const {
    double largest = 0;
    for (const Element& element : elements_) {
        const Positions8 x = local_positions(nodes_m, element.nodes);
        largest = std::max(largest, volume_term_1_s2(element, x) - element.at_rest_1_s2);
    }
    return largest;
}

double CurrentStep::step_s(double step_at_rest_s, double rise_1_s2) {
    return 2 / std::sqrt(4 / (step_at_rest_s * step_at_rest_s) + rise_1_s2);
}

}  // namespace magfsi::structure
