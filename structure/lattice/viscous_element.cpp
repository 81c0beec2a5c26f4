#include "structure/lattice/viscous_element.h"

#include <algorithm>

namespace magfsi::structure {
namespace {

// Force -dt^T s with s the stress on the products t_ij = u_i . v_j.
Positions8 force_of_products(const HourglassReference& reference,
                             const HourglassProducts& stress, const Eigen::Matrix3d& edge,
                             const Eigen::Matrix<double, 3, 4>& hourglass) {
    Positions8 out = Positions8::Zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double s = stress(3 * i + j);
            out -= s * reference.edge.col(i) * hourglass.col(j).transpose();
            out -= s * reference.hourglass.col(j) * edge.col(i).transpose();
        }
    }
    return out;
}

void add_hourglass(const ElementReference& element, const Material& material,
                   const Positions8& x, const Positions8& v, ViscousState& out) {
    const double viscosity = material.viscosity_pa_s;
    const HourglassReference& reference = element.hourglass;
    const Eigen::Matrix3d edge = x.transpose() * reference.edge;
    const Eigen::Matrix3d edge_rate = v.transpose() * reference.edge;
    const Eigen::Matrix<double, 3, 4> hourglass = x.transpose() * reference.hourglass;
    const Eigen::Matrix<double, 3, 4> hourglass_rate =
        v.transpose() * reference.hourglass;
    const Eigen::Matrix<double, 3, 4> rate =
        edge_rate.transpose() * hourglass + edge.transpose() * hourglass_rate;
    HourglassProducts products;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) products(3 * i + j) = rate(i, j);
    }
    const HourglassProducts stress = hourglass_stress(
        reference, viscosity, viscous_plate_lambda_pa_s(material), products);
    out.dissipation_w += stress.dot(products);
    out.force_n += force_of_products(reference, stress, edge, hourglass);

    const Eigen::Vector3d p(reference.metric[1](0, 0), reference.metric[0](0, 0),
                            reference.metric[0](1, 1));
    const Eigen::Vector3d last =
        element.volume / 3 * viscosity * p.minCoeff() * p.cwiseProduct(rate.col(3));
    out.dissipation_w += last.dot(rate.col(3));
    out.force_n -= reference.edge * last * hourglass.col(3).transpose();
    out.force_n -= reference.hourglass.col(3) * (edge * last).transpose();
}

}  // namespace

double viscous_plate_lambda_pa_s(const Material& material) {
    const double thinning = material.lame_lambda_pa /
                            (material.lame_lambda_pa + 2 * material.shear_modulus_pa);
    return 2 * material.viscosity_pa_s * thinning * thinning;
}

ViscousState viscous_element(const ElementReference& reference, const Material& material,
                             const Positions8& x_m, const Positions8& v_m_s) {
    const double viscosity = material.viscosity_pa_s;
    const Eigen::Matrix3d f = x_m.transpose() * reference.gradient / reference.volume;
    const Eigen::Matrix3d rate =
        v_m_s.transpose() * reference.gradient / reference.volume;
    const Eigen::Matrix3d product = f.transpose() * rate;
    const Eigen::Matrix3d strain_rate = 0.5 * (product + product.transpose());
    ViscousState out;
    out.dissipation_w = 2 * viscosity * reference.volume * strain_rate.squaredNorm();
    out.force_n = -2 * viscosity * reference.gradient * strain_rate * f.transpose();
    add_hourglass(reference, material, x_m, v_m_s, out);
    return out;
}

Matrix24 viscous_damping_at_rest(const ElementReference& reference,
                                 const Material& material, const Positions8& nodes_m) {
    Matrix24 out;
    for (int q = 0; q < 24; ++q) {
        Positions8 v = Positions8::Zero();
        v(q / 3, q % 3) = 1;
        const Positions8 force = viscous_element(reference, material, nodes_m, v).force_n;
        for (int p = 0; p < 24; ++p) out(p, q) = -force(p / 3, p % 3);
    }
    return out;
}

}  // namespace magfsi::structure
