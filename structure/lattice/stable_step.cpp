#include "structure/lattice/stable_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/lattice/element_energy.h"
#include "structure/lattice/volume.h"

namespace magfsi::structure {
namespace {

using Matrix24 = Eigen::Matrix<double, 24, 24>;
using Vector24 = Eigen::Matrix<double, 24, 1>;

Vector24 flat(const Positions8& p) {
    Vector24 out;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) out(3 * a + d) = p(a, d);
    }
    return out;
}

VolumeAndGradient volume(const ElementReference& reference, const Positions8& x) {
    return reference.variant == ElementVariant::full
               ? exact_volume(x)
               : mean_volume(x, reference.gradient, reference.volume);
}

// d2V / dx dx. The gradient is quadratic in x, so a central difference is exact.
Matrix24 volume_curvature(const ElementReference& reference, const Positions8& x) {
    const double h = std::cbrt(reference.volume);
    Matrix24 out;
    for (int q = 0; q < 24; ++q) {
        Positions8 plus = x;
        Positions8 minus = x;
        plus(q / 3, q % 3) += h;
        minus(q / 3, q % 3) -= h;
        const Positions8 change =
            volume(reference, plus).gradient_m2 - volume(reference, minus).gradient_m2;
        out.col(q) = flat(change) / (2 * h);
    }
    return out;
}

// K_e = G L + (K + G) / V0 dV dV^T - G d2V at J = 1.
Matrix24 stiffness_at_rest(const ElementReference& reference, const Material& material,
                           const Positions8& x) {
    const double g = material.shear_modulus_pa;
    const Vector24 slope = flat(volume(reference, x).gradient_m2);
    Matrix24 out =
        (material.lame_lambda_pa + g) / reference.volume * slope * slope.transpose() -
        g * volume_curvature(reference, x);
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
            for (int d = 0; d < 3; ++d) {
                out(3 * a + d, 3 * b + d) += g * reference.spring_matrix(a, b);
            }
        }
    }
    return out;
}

double largest_frequency_squared(const Positions8& x, const Body& body, int number) {
    const ElementReference reference = element_reference(x, body.element, number);
    Vector24 inverse_root_mass;
    for (int q = 0; q < 24; ++q) {
        const double mass = body.material.density_kg_m3 * reference.node_volume[q / 3];
        inverse_root_mass(q) = 1 / std::sqrt(mass);
    }
    const Matrix24 scaled = inverse_root_mass.asDiagonal() *
                            stiffness_at_rest(reference, body.material, x) *
                            inverse_root_mass.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix24> solver(scaled, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()(23);
}

}  // namespace

double stable_step_s(const Body& body) {
    if (!(body.material.density_kg_m3 > 0)) {
        throw std::invalid_argument(
            fmt::format("body {} has an effective density of {:g} kg/m3, it must be "
                        "positive (explicit "
                        "steps cannot carry a body that is lighter than its fluid)",
                        body.name, body.material.density_kg_m3));
    }
    double largest = 0;
    Positions8 solved = Positions8::Zero();  // shape of the element solved last
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
        Positions8 x = gather(body.mesh.nodes, body.mesh.elements[e]);
        x.rowwise() -= x.row(0).eval();
        // Neighbours of one shape, as in a block of bricks, need only one solution.
        if ((x - solved).norm() <= 1e-9 * x.norm()) continue;
        solved = x;
        largest =
            std::max(largest, largest_frequency_squared(x, body, static_cast<int>(e)));
    }
    return 2 / std::sqrt(largest);
}

}  // namespace magfsi::structure
