#include "structure/lattice/rest_stiffness.h"

#include <cmath>

namespace magfsi::structure {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

Vector24 flat(const Positions8& p) {
    Vector24 out;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) out(3 * a + d) = p(a, d);
    }
    return out;
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
        const Positions8 change = element_volume(reference, plus).gradient_m2 -
                                  element_volume(reference, minus).gradient_m2;
        out.col(q) = flat(change) / (2 * h);
    }
    return out;
}

}  // namespace

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

}  // namespace magfsi::structure
