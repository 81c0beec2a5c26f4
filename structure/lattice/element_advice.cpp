#include "structure/lattice/element_advice.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "structure/lattice/plate_stiffness.h"

namespace magfsi::structure {
namespace {

constexpr double allowed_error = 0.05;
constexpr int most_layers = 16;

double larger(std::initializer_list<double> errors) {
    double out = 0;
    for (double error : errors) {
        if (std::abs(error) > std::abs(out)) out = error;
    }
    return out;
}

// Of a beam along in-plane axis i, whose other curvature is free.
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

// The fewest layers of the same in-plane edges that help, or 0.
int layers_that_help(ElementVariant variant, Vec3 edges_m, int axis, int layers,
                     const Material& material) {
    const double thickness = layers * edges_m[axis];
    for (int more = layers + 1; more <= most_layers; ++more) {
        edges_m[axis] = thickness / more;
        const double worst = errors(variant, edges_m, axis, more, material).worst();
        if (std::abs(worst) <= allowed_error) return more;
    }
    return 0;
}

}  // namespace

double ElementAdvice::worst() const {
    return larger({bending_error, twist_error, dome_error, saddle_error});
}

ElementAdvice element_advice(ElementVariant variant, const Vec3& edges_m,
                             int thickness_axis, int layers, const Material& material) {
    for (double edge : edges_m) {
        if (!(edge > 0)) {
            throw std::invalid_argument(fmt::format(
                "an element of {:g} x {:g} x {:g} m found, its edges must be positive",
                edges_m[0], edges_m[1], edges_m[2]));
        }
    }
    ElementAdvice out = errors(variant, edges_m, thickness_axis, layers, material);
    const std::string wrong = faults(out);
    if (wrong.empty()) return out;
    const int more = layers_that_help(variant, edges_m, thickness_axis, layers, material);
    out.text = fmt::format(
        "element {} in {} layer{} is {}: take element assumed_strain{}", name_of(variant),
        layers, layers == 1 ? "" : "s", wrong,
        more > 0 ? fmt::format(" or {} layers of the same edges in the plane", more)
                 : "");
    return out;
}

}  // namespace magfsi::structure
