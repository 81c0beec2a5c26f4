#include <gtest/gtest.h>

#include "structure/equilibrium/tangent.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

TEST(Tangent, IsMinusTheForceGradientInRandomStatesOfDistortedElements) {
    const Material material = test::soft_material();
    const double h = 1e-9;  // of 1e-4: truncation (h/l)^2 = 1e-10, rounding about 1e-11
    // Truncation and rounding, times the stiffening in the most bent states.
    const double tolerance = 1e-8;
    test::Random random(11);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 10; ++trial) {
            const Positions8 rest = test::distorted_element(random);
            const ElementReference reference = element_reference(rest, variant, 0);
            const Positions8 x =
                random.moved(rest * random.rotation().transpose(), 1.5e-5);
            ASSERT_GT(element_energy(reference, material, x).volume_ratio, 0);
            const Matrix24 tangent = element_tangent(reference, material, x);
            EXPECT_LT((tangent - tangent.transpose()).norm(), 1e-13 * tangent.norm());
            for (int q = 0; q < 24; ++q) {
                Positions8 plus = x;
                Positions8 minus = x;
                plus(q / 3, q % 3) += h;
                minus(q / 3, q % 3) -= h;
                const Positions8 slope =
                    (element_energy(reference, material, minus).force_n -
                     element_energy(reference, material, plus).force_n) /
                    (2 * h);
                for (int p = 0; p < 24; ++p) {
                    EXPECT_NEAR(tangent(p, q), slope(p / 3, p % 3),
                                tolerance * tangent.norm());
                }
            }
        }
    }
}

TEST(Tangent, LeavesTranslationsAndTurnsAtRestFree) {
    test::Random random(12);
    for (ElementVariant variant : test::all_variants) {
        const Positions8 x = test::distorted_element(random);
        const Matrix24 tangent =
            element_tangent(element_reference(x, variant, 0), test::soft_material(), x);
        const Eigen::SelfAdjointEigenSolver<Matrix24> eigen(tangent);
        const double largest = eigen.eigenvalues()(23);
        // Six rigid motions, to rounding; the seventh mode is a real deformation.
        EXPECT_LT(eigen.eigenvalues().head<6>().cwiseAbs().maxCoeff(), 1e-12 * largest);
        EXPECT_GT(eigen.eigenvalues()(6), 1e-4 * largest);
    }
}

}  // namespace
}  // namespace magfsi::structure
