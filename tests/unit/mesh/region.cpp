// SPDX-License-Identifier: GPL-2.0-or-later
// Regions of a mesh by shapes.
#include "structure/mesh/region.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "structure/mesh/block_mesh.h"
#include "tests/support/checks.h"

namespace magfsi::structure {
namespace {

const Box block{{4e-3, 2e-3, 1e-3}, {4, 2, 1}};

NamedRegion box(const std::string& name, const Vec3& low, const Vec3& high) {
    return {name, {.box_m = std::array{low, high}, .polygon_xy_m = {}, .ball = {}}};
}

// Names of the regions of the elements.
std::vector<std::string> names(const Mesh& mesh) {
    std::vector<std::string> out;
    for (const int region : mesh.region) out.push_back(mesh.region_names[region]);
    return out;
}

TEST(Regions, HoldTheElementsWhoseCentreIsInside) {
    Mesh mesh = box_mesh(block);
    const NamedRegion ball{"ball", {{}, {}, BallShape{{3.5e-3, 0.5e-3, 0.5e-3}, 0.1e-3}}};
    const NamedRegion triangle{"triangle",
                               {{}, {{0, 1e-3}, {1.2e-3, 1e-3}, {0.5e-3, 2e-3}}, {}}};
    add_regions(mesh,
                std::array{ball, box("left", {0, 0, 0}, {1e-3, 1e-3, 1e-3}), triangle});
    EXPECT_EQ(names(mesh),
              (std::vector<std::string>{"left", "rest", "rest", "ball", "triangle",
                                        "rest", "rest", "rest"}));
}

TEST(Regions, FirstOfTwoWins) {
    Mesh mesh = box_mesh(block);
    add_regions(mesh, std::array{box("a", {0, 0, 0}, {2e-3, 2e-3, 1e-3}),
                                 box("b", {1e-3, 0, 0}, {3e-3, 2e-3, 1e-3})});
    EXPECT_EQ(names(mesh),
              (std::vector<std::string>{"a", "a", "b", "rest", "a", "a", "b", "rest"}));
}

TEST(Regions, LeaveTheMeshsOwnToTheOthers) {
    Mesh mesh = oblique_mesh({{2, 1}, 1e-3, 1e-3, 1.57, 0.1e-3, {1, 1, 1}, false});
    const std::vector<std::string> own = names(mesh);
    add_regions(mesh, std::array{box("tip", {1e-3, 0, 0}, {3e-3, 2e-3, 1e-3})});
    EXPECT_EQ(names(mesh), (std::vector<std::string>{own[0], "tip"}));
}

TEST(Regions, WithoutElementsOrOfATakenNameAreRefused) {
    Mesh mesh = box_mesh(block);
    test::expect_refusal<std::invalid_argument>(
        [&] {
            add_regions(mesh, std::array{box("far", {1, 1, 1}, {2, 2, 2})});
        },
        {"region \"far\"", "own frame"});
    Mesh other = box_mesh(block);
    test::expect_refusal<std::invalid_argument>(
        [&] {
            add_regions(other, std::array{box("rest", {0, 0, 0}, {1, 1, 1})});
        },
        {"region \"rest\"", "of that name"});
}

}  // namespace
}  // namespace magfsi::structure
