// SPDX-License-Identifier: GPL-2.0-or-later
// A graded axis: cubic cells where they are wanted, gentle growth elsewhere, all of the
// box.
#include "adapters/solvers/openfoam/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace magfsi::openfoam {
namespace {

constexpr double length_m = 16e-3, spacing_m = 0.2e-3;
constexpr double rounding = 1e-9;  // of a width of some cells among a hundred

std::vector<double> widths(const std::vector<double>& planes_m) {
    std::vector<double> width;
    for (std::size_t i = 1; i < planes_m.size(); ++i)
        width.push_back((planes_m[i] - planes_m[i - 1]) / spacing_m);
    return width;
}

TEST(GradedAxis, UniformWithoutGrading) {
    const auto planes = axis_planes(length_m, spacing_m, nullptr);
    ASSERT_EQ(planes.size(), 81u);
    for (const double width : widths(planes)) EXPECT_NEAR(width, 1, rounding);
}

TEST(GradedAxis, CellsAreCubicInsideAndGrowGentlyOutside) {
    const UniformPart parts[] = {{5e-3, 11e-3, 1.15},
                                 {0, 3.1e-3, 1.1},
                                 {12e-3, 16e-3, 1.5},
                                 {0.2e-3, 15.8e-3, 1.2}};
    for (const UniformPart& part : parts) {
        const auto planes = axis_planes(length_m, spacing_m, &part);
        EXPECT_EQ(planes.front(), 0);
        EXPECT_EQ(planes.back(), length_m);
        const auto width = widths(planes);
        for (std::size_t i = 0; i < width.size(); ++i) {
            const double middle = (planes[i] + planes[i + 1]) / 2;
            if (middle > part.from_m && middle < part.to_m) {
                EXPECT_NEAR(width[i], 1, rounding);
            }
            EXPECT_GT(width[i], 1 - rounding);
            if (i == 0) continue;
            const double ratio =
                std::max(width[i] / width[i - 1], width[i - 1] / width[i]);
            EXPECT_LT(ratio, part.growth * (1 + rounding));
        }
    }
}

TEST(GradedAxis, EveryUniformCellHasItsCentreInTheCellThatStandsForIt) {
    const UniformPart part{5e-3, 11e-3, 1.15};
    const auto planes = axis_planes(length_m, spacing_m, &part);
    const auto cell = cell_of_uniform(planes, spacing_m);
    ASSERT_EQ(cell.size(), 80u);
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const double centre = (static_cast<double>(i) + 0.5) * spacing_m;
        EXPECT_LE(planes[static_cast<std::size_t>(cell[i])], centre);
        EXPECT_GE(planes[static_cast<std::size_t>(cell[i]) + 1], centre);
    }
    // Every cell stands for some, or a rank could have nothing to show.
    for (int c = 0; c <= cell.back(); ++c)
        EXPECT_TRUE(std::ranges::binary_search(cell, c)) << c;
}

}  // namespace
}  // namespace magfsi::openfoam
