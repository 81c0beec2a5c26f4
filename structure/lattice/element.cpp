// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/element.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace magfsi::structure {
namespace {

using Hourglass = Eigen::Matrix<double, 8, 4>;
constexpr std::array<int, 4> hourglass_modes{3, 6, 5, 7};  // xy, yz, xz, xyz
constexpr std::array<std::array<int, 2>, 3> mode_axes{{{0, 1}, {1, 2}, {0, 2}}};

// Hourglass vectors made blind to linear fields: gamma = h - b (X^T h) / V0.
Hourglass hourglass_vectors(const Positions8& nodes_m, const HexahedronIntegrals& in) {
    Hourglass gamma;
    for (int k = 0; k < 4; ++k) {
        Eigen::Matrix<double, 8, 1> h;
        for (int a = 0; a < 8; ++a) h(a) = mode_sign(hourglass_modes[k], a);
        gamma.col(k) = h - in.gradient * (nodes_m.transpose() * h) / in.volume;
    }
    return gamma;
}

// Square roots of the factors on the entries of C of the element full.
Eigen::Vector4d hourglass_scale(const Vec3& length, ElementVariant variant) {
    Eigen::Vector4d scale = Eigen::Vector4d::Ones();
    double smallest = INFINITY;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double li = length[mode_axes[k][0]];
        const double lj = length[mode_axes[k][1]];
        const double shorter = std::min(li, lj);
        scale(k) = std::sqrt(3 * shorter * shorter / (li * li + lj * lj));
        smallest = std::min(smallest, li * li * lj * lj);
        sum += li * li * lj * lj;
    }
    if (variant == ElementVariant::mean_f) return scale;
    return {0, 0, 0, std::sqrt(3 * smallest / sum)};
}

// Which products make a group's strain (E_11, E_22, 2 E_12). Row j of a hourglass vector:
// 0 xy, 1 xz, 2 yz.
struct Group {
    int first_normal, second_normal;
    std::array<int, 2> shear;
};
constexpr std::array<Group, 3> groups{{
    {3 * 1 + 0, 3 * 2 + 1, {3 * 1 + 1, 3 * 2 + 0}},  // varies along x: y.xy, z.xz
    {3 * 0 + 0, 3 * 2 + 2, {3 * 0 + 2, 3 * 2 + 0}},  // along y: x.xy, z.yz
    {3 * 0 + 1, 3 * 1 + 2, {3 * 0 + 2, 3 * 1 + 1}},  // along z: x.xz, y.yz
}};

struct Vectors {
    Eigen::Matrix3d edge;  // one a column
    Eigen::Matrix<double, 3, 4> hourglass;
};

Vectors vectors(const HourglassReference& reference, const Positions8& x) {
    Vectors out;
    out.edge = x.transpose() * reference.edge;
    out.hourglass = x.transpose() * reference.hourglass;
    return out;
}

// sum_ij s_ij d(u_i . v_j)/dx_a.
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

constexpr int plane_edges[3][2] = {{1, 2}, {0, 2}, {0, 1}};  // of the groups

// u_i . v_j and u_i . u_j; or a change of theirs, or what they are worth.
struct Products {
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d metric = Eigen::Matrix3d::Zero();
};

// Strain, inverse metric and what follows from them in one group's plane.
struct PlaneState {
    const Eigen::Matrix2d& rest;  // M0
    double g, lambda, beta;
    Eigen::Matrix2d e, m, a, n;  // eps, M, A, M eps M
    double area, trace, w;       // det M / det M0; tr A; [...] of hourglass_energy
    double q() const { return 1 - beta + beta * area; }
};

Eigen::Matrix2d in_plane(const Eigen::Matrix3d& full, int k) {
    Eigen::Matrix2d out;
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j)
            out(i, j) = full(plane_edges[k][i], plane_edges[k][j]);
    }
    return out;
}

// Strain of group k, from rows of edges and columns xy, xz, yz.
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
                 0};
    s.a = s.m * s.e;
    s.n = s.a * s.m;
    s.area = s.m.determinant() / s.rest.determinant();
    s.trace = s.a.trace();
    s.w = 0.5 * s.g * (s.a * s.a).trace() + 0.5 * s.lambda * s.trace * s.trace;
    return s;
}

// dE / d eps and dE / d metric over V0 / 3.
struct PlaneStress {
    Eigen::Matrix2d strain, metric;
};

PlaneStress plane_stress(const PlaneState& s) {
    const Eigen::Matrix2d mixed = s.rest * s.e * s.m;
    return {
        0.5 * s.g * (mixed + mixed.transpose()) +
            s.q() * (s.g * s.n + s.lambda * s.trace * s.m),
        -(0.5 * s.g * s.a * mixed + s.q() * (s.g * s.a * s.n + s.lambda * s.trace * s.n) +
          s.beta * s.area * s.w * s.m)};
}

// Its change with that of strain and metric.
PlaneStress stress_change(const PlaneState& s, const Eigen::Matrix2d& de,
                          const Eigen::Matrix2d& dmetric) {
    const Eigen::Matrix2d dm = -s.m * dmetric * s.m;
    const Eigen::Matrix2d da = dm * s.e + s.m * de;
    const Eigen::Matrix2d dn = da * s.m + s.a * dm;
    const double darea = -s.area * (s.m * dmetric).trace();
    const double dtrace = da.trace();
    const double dw = s.g * (s.a * da).trace() + s.lambda * s.trace * dtrace;
    const Eigen::Matrix2d mixed = s.rest * s.e * s.m;
    const Eigen::Matrix2d dmixed = s.rest * (de * s.m + s.e * dm);
    PlaneStress out;
    out.strain = 0.5 * s.g * (dmixed + dmixed.transpose()) +
                 s.beta * darea * (s.g * s.n + s.lambda * s.trace * s.m) +
                 s.q() * (s.g * dn + s.lambda * (dtrace * s.m + s.trace * dm));
    out.metric = -(
        0.5 * s.g * (da * mixed + s.a * dmixed) +
        s.beta * darea * (s.g * s.a * s.n + s.lambda * s.trace * s.n) +
        s.q() * (s.g * (da * s.n + s.a * dn) + s.lambda * (dtrace * s.n + s.trace * dn)) +
        s.beta * (darea * s.w * s.m + s.area * dw * s.m + s.area * s.w * dm));
    return out;
}

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

Matrix8 spring_matrix(const Positions8& nodes_m, const HexahedronIntegrals& in,
                      ElementVariant variant) {
    if (variant == ElementVariant::full) return in.laplacian;
    const Matrix8 mean = in.gradient * in.gradient.transpose() / in.volume;
    const Hourglass gamma = hourglass_vectors(nodes_m, in);
    // in.laplacian - mean = Gamma C Gamma^T, solved for C.
    const Eigen::Matrix4d inverse = (gamma.transpose() * gamma).inverse();
    Eigen::Matrix4d c =
        inverse * (gamma.transpose() * (in.laplacian - mean) * gamma) * inverse;
    const Eigen::Vector4d scale =
        hourglass_scale(element_edges(nodes_m).length_m, variant);
    c = scale.asDiagonal() * c * scale.asDiagonal();
    return mean + gamma * c * gamma.transpose();
}

// x(xi) = sum_m u_m xi^m with the Hadamard modes u_m = 1/8 sum_a h_m(a) x_a. The integral
// of det(dx/dxi) over [-1, 1]^3 leaves the terms that are even in each direction: V = 8
// [r1.(r2 x r3) + (r1.(s12 x s31) + r2.(s23 x s12) + r3.(s31 x s23)) / 3].
VolumeAndGradient exact_volume(const Positions8& x_m) {
    std::array<Eigen::Vector3d, 8> u;
    for (int m = 0; m < 8; ++m) {
        u[m].setZero();
        for (int a = 0; a < 8; ++a) {
            u[m] += 0.125 * mode_sign(m, a) * x_m.row(a).transpose();
        }
    }
    const auto &r1 = u[1], &r2 = u[2], &r3 = u[4], &s12 = u[3], &s23 = u[6], &s31 = u[5];
    std::array<Eigen::Vector3d, 7> d;  // dV/du_m / 8
    d[0].setZero();
    d[1] = r2.cross(r3) + s12.cross(s31) / 3;
    d[2] = r3.cross(r1) + s23.cross(s12) / 3;
    d[4] = r1.cross(r2) + s31.cross(s23) / 3;
    d[3] = (s31.cross(r1) + r2.cross(s23)) / 3;
    d[6] = (s12.cross(r2) + r3.cross(s31)) / 3;
    d[5] = (r1.cross(s12) + s23.cross(r3)) / 3;
    VolumeAndGradient out;
    out.volume_m3 =
        8 *
        (r1.dot(r2.cross(r3)) +
         (r1.dot(s12.cross(s31)) + r2.dot(s23.cross(s12)) + r3.dot(s31.cross(s23))) / 3);
    for (int a = 0; a < 8; ++a) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int m = 1; m < 7; ++m) sum += mode_sign(m, a) * d[m];
        out.gradient_m2.row(a) = sum.transpose();
    }
    return out;
}

VolumeAndGradient mean_volume(const Positions8& x_m,
                              const Positions8& reference_gradient_m2,
                              double reference_volume_m3) {
    const Eigen::Matrix3d f =
        x_m.transpose() * reference_gradient_m2 / reference_volume_m3;
    Eigen::Matrix3d cofactor;
    cofactor.col(0) = f.col(1).cross(f.col(2));
    cofactor.col(1) = f.col(2).cross(f.col(0));
    cofactor.col(2) = f.col(0).cross(f.col(1));
    VolumeAndGradient out;
    out.volume_m3 = reference_volume_m3 * f.determinant();
    out.gradient_m2 = reference_gradient_m2 * cofactor.transpose();
    return out;
}

// With E = [[a, s/2], [s/2, b]] covariant and the inverse metric M the stress is
// 2 G M E M + lambda' tr(M E) M.
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
        // Quadratic in the strain.
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

// d2E = dp^T (d2E/dp2) dp + dE/dp d2p over the products p.
Matrix24 hourglass_tangent(const HourglassReference& reference, const Material& material,
                           const Positions8& x_m) {
    const Vectors v = vectors(reference, x_m);
    const Products p = products_of(v);
    const std::array<PlaneState, 3> state{plane_state(reference, material, p, 0),
                                          plane_state(reference, material, p, 1),
                                          plane_state(reference, material, p, 2)};
    Products slope;
    for (int k = 0; k < 3; ++k)
        add_plane(slope, plane_stress(state[k]), reference.volume_m3 / 3, k);
    Eigen::Matrix<double, 18, 24> change, stress;
    for (int q = 0; q < 24; ++q) {
        const int a = q / 3, d = q % 3;
        const Eigen::RowVector3d edge = reference.edge.row(a);
        const Eigen::RowVector3d hourglass = reference.hourglass.row(a).head<3>();
        const Products dp{
            edge.transpose() * v.hourglass.row(d).head<3>() +
                v.edge.row(d).transpose() * hourglass,
            edge.transpose() * v.edge.row(d) + v.edge.row(d).transpose() * edge};
        Products dslope;
        for (int k = 0; k < 3; ++k) {
            add_plane(dslope,
                      stress_change(state[k], group_strain(dp.strain, k),
                                    in_plane(dp.metric, k)),
                      reference.volume_m3 / 3, k);
        }
        change.col(q) << dp.strain.reshaped(), dp.metric.reshaped();
        stress.col(q) << dslope.strain.reshaped(), dslope.metric.reshaped();
    }
    Matrix24 out = change.transpose() * stress;
    const auto gamma = reference.hourglass.leftCols<3>();
    const Matrix8 mixed = reference.edge * slope.strain * gamma.transpose();
    const Matrix8 pairs = mixed + mixed.transpose() +
                          2 * reference.edge * slope.metric * reference.edge.transpose();
    for (int d = 0; d < 3; ++d) out(Eigen::seqN(d, 8, 3), Eigen::seqN(d, 8, 3)) += pairs;
    return out;
}

ElementReference element_reference(const Positions8& nodes_m, ElementVariant variant,
                                   int element_number) {
    const HexahedronIntegrals integrals = integrate_hexahedron(nodes_m, element_number);
    return {variant,
            spring_matrix(nodes_m, integrals, variant),
            integrals.gradient,
            integrals.volume,
            integrals.node_volume,
            hourglass_reference(nodes_m, integrals)};
}

VolumeAndGradient element_volume(const ElementReference& reference,
                                 const Positions8& x_m) {
    return reference.variant == ElementVariant::full
               ? exact_volume(x_m)
               : mean_volume(x_m, reference.gradient, reference.volume);
}

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
