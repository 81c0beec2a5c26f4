// SPDX-License-Identifier: GPL-2.0-or-later
// Strains of the hourglass vectors: energy and tangent (assumed_strain), damping (all
// variants).
#include <Eigen/Dense>

#include "structure/lattice/element.h"

namespace magfsi::structure {
namespace {

// Products that make up a group's strain (E_11, E_22, 2 E_12), as numbers 3 i + j of u_i
// . v_j, where j is 0 for xy, 1 for xz, 2 for yz.
struct Group {
    int first_normal, second_normal;
    std::array<int, 2> shear;
};
constexpr std::array<Group, 3> groups{{
    {3 * 1 + 0, 3 * 2 + 1, {3 * 1 + 1, 3 * 2 + 0}},  // varies along x: y.xy, z.xz
    {3 * 0 + 0, 3 * 2 + 2, {3 * 0 + 2, 3 * 2 + 0}},  // along y: x.xy, z.yz
    {3 * 0 + 1, 3 * 1 + 2, {3 * 0 + 2, 3 * 1 + 1}},  // along z: x.xz, y.yz
}};

// Half edges and hourglass vectors at given positions.
struct Vectors {
    Eigen::Matrix3d edge;  // one per column
    Eigen::Matrix<double, 3, 4> hourglass;
};

// At velocities in place of positions it gives the rates of these vectors.
Vectors vectors(const HourglassReference& reference, const Positions8& x) {
    Vectors out;
    out.edge = x.transpose() * reference.edge;
    out.hourglass = x.transpose() * reference.hourglass;
    return out;
}

// Gradient sum_ij s_ij d(u_i . v_j)/dx_a.
Positions8 products_gradient(const HourglassReference& reference,
                             const HourglassProducts& s, const Vectors& v) {
    Positions8 out = Positions8::Zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double factor = s(3 * i + j);
            out += factor * reference.edge.col(i) * v.hourglass.col(j).transpose();
            out += factor * reference.hourglass.col(j) * v.edge.col(i).transpose();
        }
    }
    return out;
}

// In-plane directions of each group
constexpr int plane_edges[3][2] = {{1, 2}, {0, 2}, {0, 1}};

// Products u_i . v_j (strain) and u_i . u_j (metric), their changes, or the derivatives
// of the energy by them.
struct Products {
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d metric = Eigen::Matrix3d::Zero();
};

// Strain, inverse metric and derived quantities of one group, with the names of
// hourglass_energy.
struct PlaneState {
    const Eigen::Matrix2d& rest;  // M0
    double g, lambda, beta;
    Eigen::Matrix2d e, m, a, n;  // eps, M, A, M eps M
    double area, trace, w;       // det M / det M0; tr A; [...] of hourglass_energy
    Eigen::Matrix2d mixed;       // M0 eps M
    Eigen::Matrix2d on_strain, on_metric;  // dw / d eps and -dw / d metric
    double q() const { return 1 - beta + beta * area; }
};

// The rows and columns of group k's plane.
Eigen::Matrix2d in_plane(const Eigen::Matrix3d& full, int k) {
    Eigen::Matrix2d out;
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j)
            out(i, j) = full(plane_edges[k][i], plane_edges[k][j]);
    }
    return out;
}

// Strain of group k. products: u_i . v_j with rows of edges and columns xy, xz, yz.
Eigen::Matrix2d group_strain(const Eigen::Matrix3d& products, int k) {
    const auto at = [&](int number) { return products(number / 3, number % 3); };
    const Group& group = groups[k];
    const double half_shear = 0.5 * (at(group.shear[0]) + at(group.shear[1]));
    Eigen::Matrix2d out;
    out << at(group.first_normal), half_shear, half_shear, at(group.second_normal);
    return out;
}

PlaneState plane_state(const HourglassReference& reference, const Material& material,
                       const Products& p, int k) {
    const double lame = material.lame_lambda_pa, g = material.shear_modulus_pa;
    PlaneState s{reference.metric[k],
                 g,
                 plane_stress_lambda_pa(material),
                 lame / (lame + 2 * g),
                 group_strain(p.strain, k),
                 in_plane(p.metric, k).inverse(),
                 {},
                 {},
                 0,
                 0,
                 0,
                 {},
                 {},
                 {}};
    s.a = s.m * s.e;
    s.n = s.a * s.m;
    s.area = s.m.determinant() / s.rest.determinant();
    s.trace = s.a.trace();
    s.w = 0.5 * s.g * (s.a * s.a).trace() + 0.5 * s.lambda * s.trace * s.trace;
    s.mixed = s.rest * s.e * s.m;
    s.on_strain = s.g * s.n + s.lambda * s.trace * s.m;
    s.on_metric = s.g * s.a * s.n + s.lambda * s.trace * s.n;
    return s;
}

// Derivatives of a group's energy by strain and metric, over V0 / 3.
struct PlaneStress {
    Eigen::Matrix2d strain, metric;
};

PlaneStress plane_stress(const PlaneState& s) {
    return {
        0.5 * s.g * (s.mixed + s.mixed.transpose()) + s.q() * s.on_strain,
        -(0.5 * s.g * s.a * s.mixed + s.q() * s.on_metric + s.beta * s.area * s.w * s.m)};
}

// Linear change of plane_stress for the changes de of the strain and dmetric of the
// metric.
PlaneStress stress_change(const PlaneState& s, const Eigen::Matrix2d& de,
                          const Eigen::Matrix2d& dmetric) {
    const Eigen::Matrix2d dm = -s.m * dmetric * s.m;
    const Eigen::Matrix2d da = dm * s.e + s.m * de;
    const Eigen::Matrix2d dn = da * s.m + s.a * dm;
    const double darea = -s.area * (s.m * dmetric).trace();
    const double dtrace = da.trace();
    const double dw = s.g * (s.a * da).trace() + s.lambda * s.trace * dtrace;
    const Eigen::Matrix2d dmixed = s.rest * (de * s.m + s.e * dm);
    PlaneStress out;
    out.strain = 0.5 * s.g * (dmixed + dmixed.transpose()) +
                 s.beta * darea * s.on_strain +
                 s.q() * (s.g * dn + s.lambda * (dtrace * s.m + s.trace * dm));
    out.metric = -(
        0.5 * s.g * (da * s.mixed + s.a * dmixed) + s.beta * darea * s.on_metric +
        s.q() * (s.g * (da * s.n + s.a * dn) + s.lambda * (dtrace * s.n + s.trace * dn)) +
        s.beta * (darea * s.w * s.m + s.area * dw * s.m + s.area * s.w * dm));
    return out;
}

// Components 11, 22 and 2 * 12, on which a stress 11, 22, 12 does work (Voigt's
// notation).
Eigen::Vector3d strains(const Eigen::Matrix2d& symmetric) {
    return {symmetric(0, 0), symmetric(1, 1), 2 * symmetric(0, 1)};
}

// Derivative of the stress by the strain, 6 x 6: components of strain first, then of
// metric.
Eigen::Matrix<double, 6, 6> plane_tangent(const PlaneState& s) {
    const Eigen::Matrix2d none = Eigen::Matrix2d::Zero();
    const std::array<Eigen::Matrix2d, 3> unit{Eigen::Matrix2d{{1, 0}, {0, 0}},
                                              Eigen::Matrix2d{{0, 0}, {0, 1}},
                                              Eigen::Matrix2d{{0, 0.5}, {0.5, 0}}};
    Eigen::Matrix<double, 6, 6> out;
    for (int j = 0; j < 6; ++j) {
        const PlaneStress change =
            j < 3 ? stress_change(s, unit[j], none) : stress_change(s, none, unit[j - 3]);
        out.col(j) << change.strain(0, 0), change.strain(1, 1), change.strain(0, 1),
            change.metric(0, 0), change.metric(1, 1), change.metric(0, 1);
    }
    return out;
}

// Adds a group's derivatives to those of the products.
void add_plane(Products& out, const PlaneStress& stress, double factor, int k) {
    const auto add = [&](int number, double value) {
        out.strain(number / 3, number % 3) += factor * value;
    };
    const Group& group = groups[k];
    add(group.first_normal, stress.strain(0, 0));
    add(group.second_normal, stress.strain(1, 1));
    for (const int shear : group.shear) add(shear, stress.strain(0, 1));
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j)
            out.metric(plane_edges[k][i], plane_edges[k][j]) +=
                factor * stress.metric(i, j);
    }
}

Products products_of(const Vectors& v) {
    return {v.edge.transpose() * v.hourglass.leftCols<3>(), v.edge.transpose() * v.edge};
}

// Adds the damping of the hourglass vectors. The last part is that of the mode xyz.
void add_hourglass(const ElementReference& element, const Material& material,
                   const Positions8& x, const Positions8& v, ViscousState& out) {
    const double viscosity = material.viscosity_pa_s;
    const HourglassReference& reference = element.hourglass;
    const Vectors at = vectors(reference, x);
    const Vectors change = vectors(reference, v);
    const Eigen::Matrix<double, 3, 4> rate =
        change.edge.transpose() * at.hourglass + at.edge.transpose() * change.hourglass;
    HourglassProducts products;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) products(3 * i + j) = rate(i, j);
    }
    const HourglassProducts stress = hourglass_stress(
        reference, viscosity, viscous_plate_lambda_pa_s(material), products);
    out.dissipation_w += stress.dot(products);
    out.force_n -= products_gradient(reference, stress, at);

    const Eigen::Vector3d p(reference.metric[1](0, 0), reference.metric[0](0, 0),
                            reference.metric[0](1, 1));
    const Eigen::Vector3d last =
        element.volume / 3 * viscosity * p.minCoeff() * p.cwiseProduct(rate.col(3));
    out.dissipation_w += last.dot(rate.col(3));
    out.force_n -= reference.edge * last * at.hourglass.col(3).transpose();
    out.force_n -= reference.hourglass.col(3) * (at.edge * last).transpose();
}

}  // namespace

// The stress is V0/3 [2 G M E M + lambda' tr(M E) M] for the covariant strain E = [[a,
// s/2], [s/2, b]] and the inverse metric M.
HourglassProducts hourglass_stress(const HourglassReference& reference, double g,
                                   double lambda, const HourglassProducts& t) {
    HourglassProducts out = HourglassProducts::Zero();
    for (int k = 0; k < 3; ++k) {
        const Group& group = groups[k];
        const double half_shear = 0.5 * (t(group.shear[0]) + t(group.shear[1]));
        Eigen::Matrix2d strain;
        strain << t(group.first_normal), half_shear, half_shear, t(group.second_normal);
        const Eigen::Matrix2d& metric = reference.metric[k];
        const Eigen::Matrix2d mixed = metric * strain;
        const Eigen::Matrix2d stress =
            reference.volume_m3 / 3 *
            (2 * g * mixed * metric + lambda * mixed.trace() * metric);
        out(group.first_normal) += stress(0, 0);
        out(group.second_normal) += stress(1, 1);
        for (int shear : group.shear) out(shear) += stress(0, 1);
    }
    return out;
}

HourglassReference hourglass_reference(const Positions8& nodes_m,
                                       const HexahedronIntegrals& integrals) {
    HourglassReference out;
    out.volume_m3 = integrals.volume;
    for (int a = 0; a < 8; ++a) {
        for (int d = 0; d < 3; ++d) {
            out.edge(a, d) = 0.125 * node_sign(a, d);
        }
        for (int j = 0; j < 4; ++j) {
            out.hourglass(a, j) = 0.125 * mode_sign(hourglass_vector_modes[j], a);
        }
    }
    out.offset_m = out.hourglass.transpose() * nodes_m;
    out.hourglass -= integrals.gradient * out.offset_m.transpose() / integrals.volume;
    const Eigen::Matrix3d half_edges = nodes_m.transpose() * out.edge;
    for (int k = 0; k < 3; ++k) {
        Eigen::Matrix<double, 3, 2> plane;
        plane << half_edges.col(plane_edges[k][0]), half_edges.col(plane_edges[k][1]);
        out.metric[k] = (plane.transpose() * plane).inverse();
    }
    return out;
}

double plane_stress_lambda_pa(const Material& material) {
    const double g = material.shear_modulus_pa;
    const double k = material.lame_lambda_pa;
    return 2 * g * k / (k + 2 * g);
}

HourglassState hourglass_energy(const HourglassReference& reference,
                                const Material& material, const Positions8& x_m) {
    const Vectors v = vectors(reference, x_m);
    const Products p = products_of(v);
    Products slope;
    HourglassState out;
    for (int k = 0; k < 3; ++k) {
        const PlaneState state = plane_state(reference, material, p, k);
        const PlaneStress stress = plane_stress(state);
        add_plane(slope, stress, reference.volume_m3 / 3, k);
        // The energy is quadratic in the strain.
        out.energy_j +=
            0.5 * reference.volume_m3 / 3 * stress.strain.cwiseProduct(state.e).sum();
    }
    const Eigen::Matrix3d on_edges =
        v.hourglass.leftCols<3>() * slope.strain.transpose() + 2 * v.edge * slope.metric;
    out.gradient_n =
        reference.edge * on_edges.transpose() +
        reference.hourglass.leftCols<3>() * (v.edge * slope.strain).transpose();
    return out;
}

// d2E = dp^T (d2E/dp2) dp + dE/dp d2p with the products p, six for each group.
Matrix24 hourglass_tangent(const HourglassReference& reference, const Material& material,
                           const Positions8& x_m) {
    const Vectors v = vectors(reference, x_m);
    const Products p = products_of(v);
    const auto gamma = reference.hourglass.leftCols<3>();
    const double third_m3 = reference.volume_m3 / 3;  // factor of each group
    Eigen::Matrix<double, 18, 24> change, stress;
    for (int q = 0; q < 24; ++q) {
        const int a = q / 3, d = q % 3;
        const Eigen::RowVector3d edge = reference.edge.row(a), along = v.edge.row(d);
        const Products dp{edge.transpose() * v.hourglass.row(d).head<3>() +
                              along.transpose() * gamma.row(a),
                          edge.transpose() * along + along.transpose() * edge};
        for (int k = 0; k < 3; ++k) {
            change.block<6, 1>(6 * k, q) << strains(group_strain(dp.strain, k)),
                strains(in_plane(dp.metric, k));
        }
    }
    Products slope;
    for (int k = 0; k < 3; ++k) {
        const PlaneState state = plane_state(reference, material, p, k);
        add_plane(slope, plane_stress(state), third_m3, k);
        stress.middleRows<6>(6 * k).noalias() =
            third_m3 * plane_tangent(state) * change.middleRows<6>(6 * k);
    }
    Matrix24 out = change.transpose() * stress;
    const Matrix8 mixed = reference.edge * slope.strain * gamma.transpose();
    const Matrix8 pairs = mixed + mixed.transpose() +
                          2 * reference.edge * slope.metric * reference.edge.transpose();
    for (int d = 0; d < 3; ++d) out(Eigen::seqN(d, 8, 3), Eigen::seqN(d, 8, 3)) += pairs;
    return out;
}

// The thickness follows the area at the rate that keeps the elastic stress through it
// zero.
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

// One column per unit velocity, as the force is linear in the velocity.
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
