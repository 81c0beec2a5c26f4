// A free element has six motions that cost nothing, the rigid ones, and no other: no
// hourglass mode is left without stiffness.
#include <gtest/gtest.h>

#include "structure/lattice/element.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

void expect_six_rigid_motions(const Positions8& x, ElementVariant variant) {
    const Material material = test::soft_material();
    const Matrix24 k = stiffness_at_rest(element_reference(x, variant, 0), material, x);
    const Eigen::SelfAdjointEigenSolver<Matrix24> solver(k, Eigen::EigenvaluesOnly);
    const auto& values = solver.eigenvalues();
    for (int i = 0; i < 6; ++i) {
        EXPECT_LT(std::abs(values(i)), 1e-13 * values(23));  // rounding
    }
    // The softest hourglass mode costs about G h, h the shortest edge, less what the
    // shape takes: far above rounding, a hundredth of it is asked for.
    const double shortest = std::sqrt(std::min({(x.row(1) - x.row(0)).squaredNorm(),
                                                (x.row(2) - x.row(0)).squaredNorm(),
                                                (x.row(4) - x.row(0)).squaredNorm()}));
    EXPECT_GT(values(6), 0.01 * material.shear_modulus_pa * shortest);
}

TEST(FreeElement, HasOnlySixMotionsWithoutStiffness) {
    for (ElementVariant variant : test::all_variants) {
        for (double r : {1.0, 2.0, 4.0}) {
            expect_six_rigid_motions(test::brick({r * 1e-4, r * 1e-4, 1e-4}), variant);
        }
        test::Random random(41);
        for (int trial = 0; trial < 10; ++trial) {
            expect_six_rigid_motions(test::distorted_element(random), variant);
        }
    }
}

// Bent elements keep it: the tangent of the hourglass energy is the difference of its
// gradient, and its energy is never negative.
TEST(HourglassEnergy, TangentIsTheDifferenceOfTheGradient) {
    const Material material = test::soft_material();
    test::Random random(42);
    for (int trial = 0; trial < 10; ++trial) {
        const Positions8 x0 = test::distorted_element(random);
        const HourglassReference reference =
            element_reference(x0, ElementVariant::assumed_strain, 0).hourglass;
        const Positions8 x = random.moved(x0 * random.rotation().transpose(), 1.5e-5);
        EXPECT_GT(hourglass_energy(reference, material, x).energy_j, 0);
        const Matrix24 tangent = hourglass_tangent(reference, material, x);
        const double h =
            1e-8;  // of 1e-4: the gradient is cubic, truncation (h/l)^2 = 1e-8
        for (int q = 0; q < 24; ++q) {
            Positions8 plus = x;
            Positions8 minus = x;
            plus(q / 3, q % 3) += h;
            minus(q / 3, q % 3) -= h;
            const Positions8 column =
                (hourglass_energy(reference, material, plus).gradient_n -
                 hourglass_energy(reference, material, minus).gradient_n) /
                (2 * h);
            for (int p = 0; p < 24; ++p) {
                EXPECT_NEAR(tangent(p, q), column(p / 3, p % 3), 1e-7 * tangent.norm());
            }
        }
    }
}

}  // namespace
}  // namespace magfsi::structure
