// SPDX-License-Identifier: GPL-2.0-or-later
// A marker spacing that no element is longer than would be passed over: it is refused,
// also of meshes that the scene's file alone does not tell.
#include <gtest/gtest.h>

#include "adapters/bodies/marker_placement.h"
#include "adapters/scene/reader.h"

namespace magfsi::bodies {
namespace {

constexpr double grid_m = 2e-4;

// Elements of 0.5 x 0.25 x 0.1 mm: the marker spacing may be up to 2.5 on the plate.
scene::Scene plate(double spacing) {
    scene::Scene scene;
    scene.fluid.emplace().spacing_m = grid_m;
    scene.fluid->box_m = {1e-2, 1e-2, 1e-2};
    scene.coupling.emplace().immersed_boundary.marker_spacing = spacing;
    scene::Body& body = scene.bodies.emplace_back();
    body.name = "plate";
    body.mesh =
        structure::ObliquePlate{{2, 1}, 1e-3, 1e-3, 1.5707963267948966, 1e-4, {2, 4, 1}};
    return scene;
}

TEST(MarkerSpacing, is_refused_above_the_longest_edge) {
    EXPECT_THROW(place_markers(plate(2.6), 0), scene::SceneError);
    EXPECT_EQ(place_markers(plate(2.5), 0).size(), 2 * 16U);  // each column two of them
}

TEST(MarkerSpacing, does_not_count_the_thickness_of_a_sheet) {
    scene::Scene thick = plate(2.6);
    std::get<structure::ObliquePlate>(thick.bodies[0].mesh).thickness_m = 6e-4;
    EXPECT_THROW(place_markers(thick, 0), scene::SceneError);
    thick.coupling->immersed_boundary.markers = coupler::Markers::volume;
    EXPECT_FALSE(place_markers(thick, 0).empty());
}

TEST(MarkerSpacing, that_nobody_asked_for_fits_every_mesh) {
    scene::Scene fine = plate(coupler::ImmersedBoundary{}.marker_spacing);
    std::get<structure::ObliquePlate>(fine.bodies[0].mesh).elements_per_cell = {20, 20,
                                                                                1};
    EXPECT_FALSE(place_markers(fine, 0).empty());
}

}  // namespace
}  // namespace magfsi::bodies
