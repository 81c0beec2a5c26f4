// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/maxwell.h"

#include <Eigen/Dense>
#include <cmath>

namespace magfsi::structure {
namespace {

using Numbers = MaxwellElement::Numbers;

// Numbers 0 to 5 as a matrix: 11, 22, 33, 12, 13, 23.
Eigen::Matrix3d branch_mean(const Numbers& n) {
    Eigen::Matrix3d out;
    out << n[0], n[3], n[4], n[3], n[1], n[5], n[4], n[5], n[2];
    return out;
}

Eigen::Matrix3d branch_gradient(const ElementReference& reference, const Positions8& x) {
    return x.transpose() * reference.gradient / reference.volume;
}

// Products u_i . v_j of each number 6 to 14 of the hourglass strains: groups x, y, z with
// E_11, E_22 and 2 E_12 (hourglass_energy). Shears are sums of two.
struct HourglassNumber {
    std::array<int, 2> products;
    int count;
};
constexpr std::array<HourglassNumber, 9> hourglass_numbers{{
    {{3, 0}, 1},
    {{7, 0}, 1},
    {{4, 6}, 2},  // y.xy, z.xz, y.xz + z.xy
    {{0, 0}, 1},
    {{8, 0}, 1},
    {{2, 6}, 2},  // x.xy, z.yz, x.yz + z.xy
    {{1, 0}, 1},
    {{5, 0}, 1},
    {{2, 4}, 2},  // x.xz, y.yz, x.yz + y.xz
}};

struct BranchVectors {
    Eigen::Matrix3d edge;
    Eigen::Matrix<double, 3, 4> hourglass;
};
BranchVectors branch_vectors(const HourglassReference& reference, const Positions8& x) {
    return {x.transpose() * reference.edge, x.transpose() * reference.hourglass};
}

// Stress that is conjugate to numbers 6 to 17, for the modulus 1.
Numbers hourglass_stress_of(const ElementReference& element, double plate_lambda,
                            const Numbers& y) {
    // The law takes products; a shear needs only its sum, put on one of the two.
    const HourglassReference& reference = element.hourglass;
    Numbers out{};
    const double third = reference.volume_m3 / 3;
    for (int k = 0; k < 3; ++k) {
        Eigen::Matrix2d strain;
        const double* own = &y[6 + 3 * k];
        strain << own[0], 0.5 * own[2], 0.5 * own[2], own[1];
        const Eigen::Matrix2d& metric = reference.metric[k];
        const Eigen::Matrix2d mixed = metric * strain;
        const Eigen::Matrix2d stress =
            third * (2 * mixed * metric + plate_lambda * mixed.trace() * metric);
        out[6 + 3 * k] = stress(0, 0);
        out[7 + 3 * k] = stress(1, 1);
        out[8 + 3 * k] = stress(0, 1);
    }
    const Eigen::Vector3d p(reference.metric[1](0, 0), reference.metric[0](0, 0),
                            reference.metric[0](1, 1));
    for (int d = 0; d < 3; ++d)
        out[15 + d] = element.volume / 3 * p.minCoeff() * p[d] * y[15 + d];
    return out;
}

// Forces of a stress on numbers 6 to 17: minus its work on their change.
Positions8 hourglass_force(const ElementReference& element, const Numbers& stress,
                           const BranchVectors& v) {
    Eigen::Matrix<double, 3, 4> on_products = Eigen::Matrix<double, 3, 4>::Zero();
    for (int n = 0; n < 9; ++n) {
        for (int k = 0; k < hourglass_numbers[n].count; ++k) {
            const int product = hourglass_numbers[n].products[k];
            on_products(product / 3, product % 3) += stress[6 + n];
        }
    }
    for (int d = 0; d < 3; ++d) on_products(d, 3) = stress[15 + d];
    const HourglassReference& reference = element.hourglass;
    return -reference.edge * on_products * v.hourglass.transpose() -
           reference.hourglass * (v.edge * on_products).transpose();
}

}  // namespace

std::vector<MaxwellFactors> maxwell_factors(const Material& material, double dt_s) {
    std::vector<MaxwellFactors> out;
    for (const MaxwellBranch& branch : material.branches) {
        const double share = dt_s / branch.time_s;
        MaxwellFactors& factors =
            out.emplace_back(MaxwellFactors{1, 0, branch.modulus_pa, 1 / branch.time_s});
        if (dt_s == 0) continue;
        factors.decay = std::exp(-share);
        factors.gain = -std::expm1(-share) / share;
    }
    return out;
}

double maxwell_plate_lambda(const Material& material) {
    Material unit = material;
    unit.viscosity_pa_s = 1;
    return viscous_plate_lambda_pa_s(unit);
}

double branch_modulus_pa(const Material& material) {
    double sum = 0;
    for (const MaxwellBranch& branch : material.branches) sum += branch.modulus_pa;
    return sum;
}

ComplexModulus complex_modulus(const Material& material, double omega_rad_s) {
    ComplexModulus out{material.shear_modulus_pa, material.viscosity_pa_s * omega_rad_s};
    for (const MaxwellBranch& branch : material.branches) {
        const double x = omega_rad_s * branch.time_s;
        const double part = branch.modulus_pa * x / (1 + x * x);
        out.storage_pa += part * x;
        out.loss_pa += part;
    }
    return out;
}

Numbers MaxwellElement::strain_at(const ElementReference& reference,
                                  const Positions8& x_m) {
    const Eigen::Matrix3d f = branch_gradient(reference, x_m);
    const Eigen::Matrix3d inverse = (f.transpose() * f).inverse();
    const BranchVectors v = branch_vectors(reference.hourglass, x_m);
    const Eigen::Matrix<double, 3, 4> products = v.edge.transpose() * v.hourglass;
    Numbers out{-inverse(0, 0), -inverse(1, 1), -inverse(2, 2),
                -inverse(0, 1), -inverse(0, 2), -inverse(1, 2)};
    for (int n = 0; n < 9; ++n) {
        for (int k = 0; k < hourglass_numbers[n].count; ++k) {
            const int product = hourglass_numbers[n].products[k];
            out[6 + n] += products(product / 3, product % 3);
        }
    }
    for (int d = 0; d < 3; ++d) out[15 + d] = products(d, 3);
    return out;
}

MaxwellElement MaxwellElement::at_rest(const ElementReference& reference,
                                       const Material& material, const Positions8& x_m) {
    return {strain_at(reference, x_m), std::vector<Numbers>(material.branches.size())};
}

MaxwellElement::State MaxwellElement::advance(const ElementReference& reference,
                                              const Material& material,
                                              const Positions8& x_m, double dt_s) {
    const Numbers now = strain_at(reference, x_m);
    const auto factors = maxwell_factors(material, dt_s);
    const double plate = maxwell_plate_lambda(material);
    const Eigen::Matrix3d f = branch_gradient(reference, x_m);
    const Eigen::Matrix3d right = f.transpose() * f;
    State out;
    out.force_n.setZero();
    for (std::size_t k = 0; k < branch.size(); ++k) {
        Numbers& d = branch[k];
        for (std::size_t n = 0; n < d.size(); ++n)
            d[n] = factors[k].decay * d[n] + factors[k].gain * (now[n] - strain[n]);
        const double modulus = factors[k].modulus_pa;
        const Eigen::Matrix3d mean = branch_mean(d);
        const Eigen::Matrix3d product =
            Eigen::Matrix3d::Identity() + mean * right;  // A C
        const Numbers stress = hourglass_stress_of(reference, plate, d);
        double bent = 0;
        for (std::size_t n = 6; n < d.size(); ++n) bent += stress[n] * d[n];
        const double scale = 0.5 * modulus * reference.volume;
        out.energy_j += scale * (product.trace() - 3 - std::log(product.determinant())) +
                        0.5 * modulus * bent;
        out.dissipation_w +=
            factors[k].rate_1_s *
            (scale * (product.trace() + product.inverse().trace() - 6) + modulus * bent);
        out.force_n -= modulus * reference.gradient * mean * f.transpose();
        out.force_n +=
            modulus *
            hourglass_force(reference, stress, branch_vectors(reference.hourglass, x_m));
    }
    strain = now;
    return out;
}

}  // namespace magfsi::structure
