#include "structure/lattice/plate_stiffness.h"

#include <fmt/format.h>

#include <stdexcept>

#include "structure/lattice/hourglass.h"
#include "structure/lattice/rest_stiffness.h"

namespace magfsi::structure {
namespace {

using Curvatures = Eigen::Matrix<double, 24, 3>;  // displacement of each unit curvature

Curvatures kirchhoff_displacement(const Positions8& x, int thickness_axis) {
    const int p = (thickness_axis + 1) % 3;
    const int q = (thickness_axis + 2) % 3;
    Curvatures u = Curvatures::Zero();
    for (int a = 0; a < 8; ++a) {
        const double z = x(a, thickness_axis);
        u(3 * a + p, 0) = -x(a, p) * z;
        u(3 * a + q, 1) = -x(a, q) * z;
        u(3 * a + p, 2) = -x(a, q) * z;
        u(3 * a + q, 2) = -x(a, p) * z;
        u(3 * a + thickness_axis, 0) = 0.5 * x(a, p) * x(a, p);
        u(3 * a + thickness_axis, 1) = 0.5 * x(a, q) * x(a, q);
        u(3 * a + thickness_axis, 2) = x(a, p) * x(a, q);
    }
    return u;
}

// Displacements of the lower and the upper level spread on the nodes.
Eigen::Matrix<double, 24, 6> level_map(const Positions8& layer, int thickness_axis) {
    const double middle = layer.col(thickness_axis).mean();
    Eigen::Matrix<double, 24, 6> out = Eigen::Matrix<double, 24, 6>::Zero();
    for (int a = 0; a < 8; ++a) {
        const int level = layer(a, thickness_axis) > middle ? 1 : 0;
        for (int d = 0; d < 3; ++d) out(3 * a + d, 3 * level + d) = 1;
    }
    return out;
}

}  // namespace

PlateStiffness kirchhoff_plate(const Material& material, double thickness_m) {
    const double l = plane_stress_lambda_pa(material);
    const double g = material.shear_modulus_pa;
    PlateStiffness out;
    out << 2 * g + l, l, 0, l, 2 * g + l, 0, 0, 0, 4 * g;
    return thickness_m * thickness_m * thickness_m / 12 * out;
}

PlateStiffness lattice_plate(ElementVariant variant, const Positions8& layer_m,
                             int thickness_axis, int layers, const Material& material) {
    if (layers < 1) {
        throw std::invalid_argument(
            fmt::format("a plate of {} layers found, at least one is needed", layers));
    }
    const auto z = layer_m.col(thickness_axis);
    const double height = z.maxCoeff() - z.minCoeff();
    const ElementReference reference = element_reference(layer_m, variant, 0);
    const Matrix24 stiffness = stiffness_at_rest(reference, material, layer_m);
    const auto spread = level_map(layer_m, thickness_axis);

    // Energy 1/2 (f^T a f + 2 f^T b k + k^T c k) over the displacements f of the levels.
    const Eigen::Index unknowns = 3 * (layers + 1);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(unknowns, 3);
    PlateStiffness c = PlateStiffness::Zero();
    Positions8 x = layer_m.rowwise() - layer_m.colwise().mean();
    x.col(thickness_axis).array() -= 0.5 * (layers - 1) * height;
    for (int layer = 0; layer < layers; ++layer) {
        const Curvatures u = kirchhoff_displacement(x, thickness_axis);
        a.block<6, 6>(3 * layer, 3 * layer) += spread.transpose() * stiffness * spread;
        b.middleRows<6>(3 * layer) += spread.transpose() * stiffness * u;
        c += u.transpose() * stiffness * u;
        x.col(thickness_axis).array() += height;
    }
    // The lowest level stays: translations cost nothing.
    const Eigen::Index free = unknowns - 3;
    const Eigen::MatrixXd f =
        a.bottomRightCorner(free, free).ldlt().solve(b.bottomRows(free));
    return (c - b.bottomRows(free).transpose() * f) * (height / reference.volume);
}

}  // namespace magfsi::structure
