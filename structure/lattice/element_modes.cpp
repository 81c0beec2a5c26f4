#include "structure/lattice/element_modes.h"

#include <algorithm>
#include <cmath>

namespace magfsi::structure {
namespace {

// Rounding leaves off-diagonals of about 1e-16 of the largest entry in bricks; a mesh
// that is distorted on purpose has them far above this.
constexpr double brick_tolerance = 1e-12;

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

}  // namespace

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

}  // namespace magfsi::structure
