// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/element_advice.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <initializer_list>

#include "structure/lattice/tangent.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Displacements of the nodes, a column for each unit curvature
using Curvatures = Eigen::Matrix<double, 24, 3>;

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

// Map from the displacements of the lower and the upper level to those of the nodes.
Eigen::Matrix<double, 24, 6> level_map(const Positions8& layer, int thickness_axis) {
    const double middle = layer.col(thickness_axis).mean();
    Eigen::Matrix<double, 24, 6> out = Eigen::Matrix<double, 24, 6>::Zero();
    for (int a = 0; a < 8; ++a) {
        const int level = layer(a, thickness_axis) > middle ? 1 : 0;
        for (int d = 0; d < 3; ++d) out(3 * a + d, 3 * level + d) = 1;
    }
    return out;
}

// Errors up to this are not mentioned.
constexpr double allowed_error = 0.05;
// Largest number of layers that is advised.
constexpr int max_layers = 16;

// The error of largest magnitude, with its sign.
double larger(std::initializer_list<double> errors) {
    double out = 0;
    for (double error : errors) {
        if (std::abs(error) > std::abs(out)) out = error;
    }
    return out;
}

// Bending stiffness of a beam along in-plane axis i, whose curvature across is free.
double beam(const PlateStiffness& d, int i) {
    return d(i, i) - d(0, 1) * d(0, 1) / d(1 - i, 1 - i);
}

ElementAdvice errors(ElementVariant variant, const Vec3& edges_m, int axis, int layers,
                     const Material& material) {
    Positions8 brick;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) brick(a, d) = 0.5 * node_sign(a, d) * edges_m[d];
    }
    const PlateStiffness found = lattice_plate(variant, brick, axis, layers, material);
    const PlateStiffness exact = kirchhoff_plate(material, layers * edges_m[axis]);
    const auto error = [&](const Eigen::Vector3d& curvature) {
        return curvature.dot(found * curvature) / curvature.dot(exact * curvature) - 1;
    };
    ElementAdvice out;
    out.bending_error =
        larger({error({1, 0, 0}), error({0, 1, 0}), beam(found, 0) / beam(exact, 0) - 1,
                beam(found, 1) / beam(exact, 1) - 1});
    out.twist_error = error({0, 0, 1});
    out.dome_error = error({1, 1, 0});
    out.saddle_error = error({1, -1, 0});
    return out;
}

std::string fault(double error, const char* mode) {
    return fmt::format("{:.0f} % too {} in {}", 100 * std::abs(error),
                       error < 0 ? "soft" : "stiff", mode);
}

std::string faults(const ElementAdvice& advice) {
    std::string out;
    const auto add = [&out](double error, const char* mode) {
        if (std::abs(error) <= allowed_error) return;
        out += (out.empty() ? "" : ", ") + fault(error, mode);
    };
    add(advice.bending_error, "bending");
    add(advice.twist_error, "twist");
    add(advice.dome_error, "bending to a dome");
    add(advice.saddle_error, "bending to a saddle");
    return out;
}

// Smallest number of layers, with the same in-plane edges, whose errors are allowed, or
// 0.
int layers_that_help(ElementVariant variant, Vec3 edges_m, int axis, int layers,
                     const Material& material) {
    const double thickness = layers * edges_m[axis];
    for (int more = layers + 1; more <= max_layers; ++more) {
        edges_m[axis] = thickness / more;
        const double worst = errors(variant, edges_m, axis, more, material).worst();
        if (std::abs(worst) <= allowed_error) return more;
    }
    return 0;
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
        refuse("a plate of {} layers found, at least one is needed", layers);
    }
    const auto z = layer_m.col(thickness_axis);
    const double height = z.maxCoeff() - z.minCoeff();
    const ElementReference reference = element_reference(layer_m, variant, 0);
    const Matrix24 stiffness = element_tangent(reference, material, layer_m);
    const auto spread = level_map(layer_m, thickness_axis);

    // The energy 1/2 (f^T a f + 2 f^T b k + k^T c k) is minimised over the levels'
    // displacements f.
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
    // The lowest level stays in place, as translations cost no energy.
    const Eigen::Index free = unknowns - 3;
    const Eigen::MatrixXd f =
        a.bottomRightCorner(free, free).ldlt().solve(b.bottomRows(free));
    return (c - b.bottomRows(free).transpose() * f) * (height / reference.volume);
}

double ElementAdvice::worst() const {
    return larger({bending_error, twist_error, dome_error, saddle_error});
}

ElementAdvice element_advice(ElementVariant variant, const Vec3& edges_m,
                             int thickness_axis, int layers, const Material& material) {
    for (double edge : edges_m) {
        if (!(edge > 0)) {
            refuse("an element of {:g} x {:g} x {:g} m found, its edges must be positive",
                   edges_m[0], edges_m[1], edges_m[2]);
        }
    }
    ElementAdvice out = errors(variant, edges_m, thickness_axis, layers, material);
    const std::string wrong = faults(out);
    if (wrong.empty()) return out;
    const int more = layers_that_help(variant, edges_m, thickness_axis, layers, material);
    const bool best = variant == ElementVariant::assumed_strain;
    std::string remedy = best ? "" : "element assumed_strain";
    if (more > 0)
        remedy += fmt::format("{}{} layers of the same edges in the plane",
                              best ? "" : " or ", more);
    if (remedy.empty()) remedy = "shorter edges in the plane";
    out.text = fmt::format("element {} in {} layer{} is {}: take {}", name_of(variant),
                           layers, layers == 1 ? "" : "s", wrong, remedy);
    return out;
}

}  // namespace magfsi::structure
