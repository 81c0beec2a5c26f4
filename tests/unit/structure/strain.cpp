// SPDX-License-Identifier: GPL-2.0-or-later
// What is told of an element's deformation: stretches and stress in homogeneous states.
#include "structure/lattice/strain.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "structure/lattice/plain_element.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

constexpr double roundoff = 1e-13;  // of a few products of order one

Eigen::Matrix3d symmetric(const std::array<double, 6>& s) {
    Eigen::Matrix3d m;
    m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    return m;
}

TEST(Strain, StretchesOfATurnedStretchAreThoseGiven) {
    test::Random random(31);
    const Eigen::Vector3d given(1.3, 1.05, 0.7);
    for (int trial = 0; trial < 20; ++trial) {
        const Eigen::Matrix3d f =
            random.rotation() * given.asDiagonal() * random.rotation();
        const Vec3 found = principal_stretches(f);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(found[static_cast<std::size_t>(i)], given[i], roundoff);
    }
}

// A bar pulled to the stretch a, with b across: sigma = (G (a^2 - 1) + K ln J) / J along
// it and the same with b across, J = a b^2.
TEST(Strain, StressOfAPulledBarIsThatOfItsClosedForm) {
    const Material material = test::soft_material();
    const double a = 1.4, b = 0.9, j = a * b * b;
    const auto s =
        cauchy_stress_pa(material, Eigen::Vector3d(a, b, b).asDiagonal().toDenseMatrix());
    const double g = material.shear_modulus_pa, k = material.lame_lambda_pa;
    EXPECT_NEAR(s[0], (g * (a * a - 1) + k * std::log(j)) / j, roundoff * k);
    EXPECT_NEAR(s[1], (g * (b * b - 1) + k * std::log(j)) / j, roundoff * k);
    EXPECT_NEAR(s[2], s[1], roundoff * k);
    for (int i = 3; i < 6; ++i) EXPECT_EQ(s[static_cast<std::size_t>(i)], 0);
}

// By virtual work the stress gives an element's forces in a homogeneous state,
// f_a = - P b_a with P = J sigma F^-T, whatever the variant; the forces are -dE/dx.
TEST(Strain, StressGivesTheForcesOfAHomogeneousElement) {
    const Material material = test::soft_material();
    test::Random random(32);
    Eigen::Matrix3d f;
    f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05;
    for (const ElementVariant variant : test::all_variants) {
        const Positions8 rest = test::distorted_element(random);
        const ElementReference reference = element_reference(rest, variant, 0);
        const Positions8 x = rest * f.transpose();
        const Eigen::Matrix3d found =
            mean_deformation(x, reference.gradient, reference.volume);
        EXPECT_LT((found - f).norm(),
                  1e-11);  // of differences of a tenth of a millimetre
        const Eigen::Matrix3d stress = symmetric(cauchy_stress_pa(material, found));
        const Eigen::Matrix3d p = f.determinant() * stress * f.inverse().transpose();
        const Positions8 expected = -reference.gradient * p.transpose();
        const Positions8 forces = element_energy(reference, material, x).force_n;
        EXPECT_LT((forces - expected).norm(), 1e-9 * forces.norm());
    }
}

}  // namespace
}  // namespace magfsi::structure
