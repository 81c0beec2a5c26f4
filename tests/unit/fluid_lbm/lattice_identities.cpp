// Moments of the weights that D3Q19 must have for Navier-Stokes.
#include <gtest/gtest.h>

#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid::d3q19 {
namespace {

constexpr double rounding = 1e-15;  // sums of 19 terms of at most 1/3

double delta(int a, int b) {
    return a == b ? 1 : 0;
}

TEST(LatticeIdentities, OppositeReversesVelocity) {
    for (int q = 0; q < directions; ++q) {
        EXPECT_EQ(opposite(opposite(q)), q);
        for (int a = 0; a < 3; ++a) EXPECT_EQ(c[opposite(q)][a], -c[q][a]);
    }
}

TEST(LatticeIdentities, MomentsToThirdOrder) {
    double zeroth = 0;
    for (int q = 0; q < directions; ++q) zeroth += weight(q);
    EXPECT_NEAR(zeroth, 1, rounding);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            for (int d = 0; d < 3; ++d) {
                double first = 0, second = 0, third = 0;
                for (int q = 0; q < directions; ++q) {
                    first += weight(q) * c[q][a];
                    second += weight(q) * c[q][a] * c[q][b];
                    third += weight(q) * c[q][a] * c[q][b] * c[q][d];
                }
                EXPECT_NEAR(first, 0, rounding);
                EXPECT_NEAR(second, cs2 * delta(a, b), rounding);
                EXPECT_NEAR(third, 0, rounding);
            }
        }
    }
}

TEST(LatticeIdentities, FourthMomentIsIsotropic) {
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            for (int d = 0; d < 3; ++d) {
                for (int e = 0; e < 3; ++e) {
                    double fourth = 0;
                    for (int q = 0; q < directions; ++q) {
                        fourth += weight(q) * c[q][a] * c[q][b] * c[q][d] * c[q][e];
                    }
                    const double isotropic = delta(a, b) * delta(d, e) +
                                             delta(a, d) * delta(b, e) +
                                             delta(a, e) * delta(b, d);
                    EXPECT_NEAR(fourth, cs2 * cs2 * isotropic, rounding);
                }
            }
        }
    }
}

}  // namespace
}  // namespace magfsi::fluid::d3q19
