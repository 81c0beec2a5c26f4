// SPDX-License-Identifier: GPL-2.0-or-later
// Endless plates of one to four layers bent, twisted, domed and saddled, against
// Kirchhoff's stiffness: every element variant, edges r = 1 to 4 times the layer, K/G
// from 2 to 100.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "structure/lattice/element_advice.h"
#include "tests/support/checks.h"

namespace magfsi::structure {
namespace {

constexpr std::array variants{ElementVariant::full, ElementVariant::assumed_strain};
constexpr std::array ratios{1.0, 1.5, 2.0, 3.0, 4.0};
constexpr std::array lames{2.0, 20.0, 100.0};

Material material(double k_over_g) {
    return {33e3, 33e3 * k_over_g, 1860};
}

void print_row(const char* name, double r, int layers, const ElementAdvice& a) {
    std::printf("%-15s %4.1f %2d %10.2f %10.2f %10.2f %10.2f\n", name, r, layers,
                100 * a.bending_error, 100 * a.twist_error, 100 * a.dome_error,
                100 * a.saddle_error);
}

// By construction: linear strains are represented exactly, so only rounding is left,
// times the cancellation between the levels of up to four layers.
constexpr double rounding = 1e-9;

TEST(PlateModes, TableOfStiffnessErrors) {
    for (double k_over_g : lames) {
        std::printf("K/G = %g, error of the stiffness in %%\n", k_over_g);
        std::printf(
            "element            r  n    bending      twist       dome     saddle\n");
        for (ElementVariant variant : variants) {
            for (double r : ratios) {
                for (int layers = 1; layers <= 4; ++layers) {
                    const auto advice =
                        element_advice(variant, {r * 1e-4, r * 1e-4, 1e-4}, 2, layers,
                                       material(k_over_g));
                    print_row(name_of(variant).data(), r, layers, advice);
                    if (variant == ElementVariant::assumed_strain) {
                        EXPECT_LT(std::abs(advice.worst()), rounding);
                    }
                }
            }
        }
    }
}

TEST(PlateModes, AssumedStrainIsExactForAnyEdgesAndLayers) {
    double worst = 0;
    for (double k_over_g : lames) {
        for (double r : {0.3, 1.0, 1.5, 2.0, 3.0, 4.0, 10.0}) {
            for (double aspect : {0.4, 1.0, 3.0}) {
                for (int layers = 1; layers <= 4; ++layers) {
                    const ElementAdvice advice =
                        element_advice(ElementVariant::assumed_strain,
                                       {r * 1e-4, aspect * r * 1e-4, 1e-4}, 2, layers,
                                       material(k_over_g));
                    worst = std::max(worst, std::abs(advice.worst()));
                    EXPECT_TRUE(advice.text.empty());
                }
            }
        }
    }
    std::printf("assumed_strain, worst error: %.2g\n", worst);
    EXPECT_LT(worst, rounding);
}

TEST(PlateModes, AssumedStrainIsExactForParallelogramsToo) {
    Positions8 x;
    for (int a = 0; a < 8; ++a) {
        const double i = 0.5 * node_sign(a, 0);
        const double j = 0.5 * node_sign(a, 1);
        // In-plane angle of about 60 degrees, axes turned by 20.
        const double p = 3e-4 * i + 1.5e-4 * j;
        const double q = 2.6e-4 * j;
        x.row(a) << 0.94 * p - 0.342 * q, 0.342 * p + 0.94 * q, 0.5e-4 * node_sign(a, 2);
    }
    for (int layers : {1, 2}) {
        const PlateStiffness found =
            lattice_plate(ElementVariant::assumed_strain, x, 2, layers, material(20));
        const PlateStiffness exact = kirchhoff_plate(material(20), layers * 1e-4);
        EXPECT_LT((found - exact).norm(), rounding * exact.norm());
    }
}

// The pairwise springs of full give each layer the bending stiffness c G h^3 / 12 about
// its own middle, with c = 1 + r^2 where the plate has 2 + lambda'/G; the share of the
// layers' own stiffness in the whole is 1 / n^2.
TEST(PlateModes, PairwiseSpringsFollowTheirClosedForm) {
    for (double r : ratios) {
        for (int layers = 1; layers <= 4; ++layers) {
            Positions8 x;
            for (int a = 0; a < 8; ++a) {
                x.row(a) << r * node_sign(a, 0), r * node_sign(a, 1), node_sign(a, 2);
            }
            const double c = 1 + r * r;
            const double exact = kirchhoff_plate(material(20), 2.0 * layers)(0, 0);
            const double found =
                lattice_plate(ElementVariant::full, x, 2, layers, material(20))(0, 0);
            const double modulus = 2 + 2 * 20 / 22.0;
            EXPECT_NEAR(found / exact - 1, (c / modulus - 1) / (layers * layers),
                        rounding)
                << "r " << r << ", layers " << layers;
        }
    }
}

TEST(ElementAdvice, SaysWhatIsWrongAndWhatHelps) {
    const auto cube =
        element_advice(ElementVariant::full, {1e-4, 1e-4, 1e-4}, 2, 1, material(20));
    test::expect_says(cube.text, {"element full in 1 layer is 49 % too soft in bending",
                                  "take element assumed_strain"});
    // The element that is advised is not advised in its own place.
    for (const double k_over_g : {0.0, 1.0, 20.0}) {
        const auto best = element_advice(ElementVariant::assumed_strain,
                                         {1e-4, 4e-4, 4e-4}, 0, 1, material(k_over_g));
        EXPECT_EQ(best.text.find("take element"), std::string::npos) << best.text;
    }
    EXPECT_THROW(
        element_advice(ElementVariant::full, {1e-4, 0, 1e-4}, 2, 1, material(20)),
        std::invalid_argument);
    EXPECT_THROW(
        element_advice(ElementVariant::full, {1e-4, 1e-4, 1e-4}, 2, 0, material(20)),
        std::invalid_argument);
    std::printf("%s\n", cube.text.c_str());
}

}  // namespace
}  // namespace magfsi::structure
