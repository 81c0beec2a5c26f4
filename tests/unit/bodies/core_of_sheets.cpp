// SPDX-License-Identifier: GPL-2.0-or-later
// Which markers are the core of a sheet, where the memory of the slip leaks more.
#include <gtest/gtest.h>

#include <algorithm>

#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::bodies {
namespace {

constexpr double grid_m = 1e-4;

scene::Scene block(const structure::Vec3& size_m, std::array<int, 3> elements) {
    scene::Scene scene;
    scene.fluid.emplace().spacing_m = grid_m;
    scene.fluid->box_m = {1e-2, 1e-2, 1e-2};
    scene.coupling.emplace().immersed_boundary.forcing = coupler::Forcing::no_slip;
    scene::Body& body = scene.bodies.emplace_back();
    body.name = "block";
    body.mesh = structure::Box{size_m, elements};
    return scene;
}

auto in_core(const scene::Scene& scene) {
    auto markers = place_markers(scene, 0, to_mesh(scene.bodies[0]));
    std::erase_if(markers, [](const PlacedMarker& m) { return !m.core; });
    return markers;
}

TEST(CoreOfSheets, lies_below_two_layers) {
    const structure::Vec3 size_m{3e-3, 2e-3, 7.4e-4};
    const scene::Scene sheet = block(size_m, {12, 8, 1});
    const auto core = in_core(sheet);
    ASSERT_FALSE(core.empty());
    const structure::Mesh mesh = to_mesh(sheet.bodies[0]);
    for (const PlacedMarker& marker : core) {
        const auto at = structure::position(mesh, marker.point);
        for (std::size_t d = 0; d < 3; ++d)
            EXPECT_GT(std::min(at[d], size_m[d] - at[d]), 2 * grid_m);
    }
}

TEST(CoreOfSheets, is_empty_in_thinner_sheets_and_other_bodies) {
    EXPECT_TRUE(in_core(block({3e-3, 2e-3, 4e-4}, {12, 8, 1})).empty());
    EXPECT_TRUE(in_core(block({1e-3, 1e-3, 1e-3}, {1, 1, 1})).empty());
}

}  // namespace
}  // namespace magfsi::bodies
