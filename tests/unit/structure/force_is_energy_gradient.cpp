#include <gtest/gtest.h>

#include "tests/unit/structure/elements.h"
#include "tests/unit/structure/plain_element.h"

namespace magfsi::structure {
namespace {

TEST(Force, IsMinusTheEnergyGradientInRandomStatesOfDistortedElements) {
    const Material material = test::soft_material();
    const double h = 1e-9;  // of 1e-4: truncation (h/l)^2 = 1e-10, rounding about 1e-9
    const double tolerance = 1e-7;  // both, times the stiffening in the most bent states
    test::Random random(7);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 10; ++trial) {
            const Positions8 reference_x = test::distorted_element(random);
            const ElementReference reference = element_reference(reference_x, variant, 0);
            const Positions8 x =
                random.moved(reference_x * random.rotation().transpose(), 1.5e-5);
            const ElementState state = element_energy(reference, material, x);
            ASSERT_GT(state.volume_ratio, 0);
            for (int q = 0; q < 24; ++q) {
                Positions8 plus = x;
                Positions8 minus = x;
                plus(q / 3, q % 3) += h;
                minus(q / 3, q % 3) -= h;
                const double slope =
                    (element_energy(reference, material, plus).energy_j -
                     element_energy(reference, material, minus).energy_j) /
                    (2 * h);
                EXPECT_NEAR(state.force_n(q / 3, q % 3), -slope,
                            tolerance * state.force_n.norm());
            }
        }
    }
}

}  // namespace
}  // namespace magfsi::structure
