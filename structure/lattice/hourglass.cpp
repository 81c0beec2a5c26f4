#include "structure/lattice/hourglass.h"

namespace magfsi::structure {
namespace {

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
    HourglassProducts product;
};

Vectors vectors(const HourglassReference& reference, const Positions8& x) {
    Vectors out;
    out.edge = x.transpose() * reference.edge;
    out.hourglass = x.transpose() * reference.hourglass;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            out.product(3 * i + j) = out.edge.col(i).dot(out.hourglass.col(j));
        }
    }
    return out;
}

}  // namespace

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
    constexpr int others[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    for (int k = 0; k < 3; ++k) {
        Eigen::Matrix<double, 3, 2> plane;
        plane << half_edges.col(others[k][0]), half_edges.col(others[k][1]);
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
    const HourglassProducts slope =
        hourglass_stress(reference, material.shear_modulus_pa,
                         plane_stress_lambda_pa(material), v.product);
    HourglassState out;
    out.energy_j = 0.5 * slope.dot(v.product);
    out.gradient_n.setZero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double s = slope(3 * i + j);
            out.gradient_n += s * reference.edge.col(i) * v.hourglass.col(j).transpose();
            out.gradient_n += s * reference.hourglass.col(j) * v.edge.col(i).transpose();
        }
    }
    return out;
}

// dt^T C dt with dt_ij = du_i . v_j + u_i . dv_j, and dE/dt . 2 du_i . dv_j.
Matrix24 hourglass_tangent(const HourglassReference& reference, const Material& material,
                           const Positions8& x_m) {
    const Vectors v = vectors(reference, x_m);
    const HourglassProducts slope =
        hourglass_stress(reference, material.shear_modulus_pa,
                         plane_stress_lambda_pa(material), v.product);
    Eigen::Matrix<double, 9, 24> change;
    Matrix8 pairs = Matrix8::Zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const auto edge = reference.edge.col(i);
            const auto hourglass = reference.hourglass.col(j);
            for (int a = 0; a < 8; ++a) {
                for (int d = 0; d < 3; ++d) {
                    change(3 * i + j, 3 * a + d) =
                        edge(a) * v.hourglass(d, j) + hourglass(a) * v.edge(d, i);
                }
            }
            pairs += slope(3 * i + j) *
                     (edge * hourglass.transpose() + hourglass * edge.transpose());
        }
    }
    Eigen::Matrix<double, 9, 24> stress;
    for (int q = 0; q < 24; ++q) {
        stress.col(q) = hourglass_stress(reference, material.shear_modulus_pa,
                                         plane_stress_lambda_pa(material), change.col(q));
    }
    Matrix24 out = change.transpose() * stress;
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
            for (int d = 0; d < 3; ++d) out(3 * a + d, 3 * b + d) += pairs(a, b);
        }
    }
    return out;
}

}  // namespace magfsi::structure
