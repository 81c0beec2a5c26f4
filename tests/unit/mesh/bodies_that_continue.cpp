// A body that spans a periodic box has no surface at its two ends there.
#include <gtest/gtest.h>

#include <algorithm>

#include "structure/mesh/block_mesh.h"
#include "structure/mesh/sheet.h"

namespace magfsi::structure {
namespace {

constexpr Continues across_z{false, false, true};

TEST(BodyThatContinues, is_a_sheet_by_its_other_sides) {
    // Thinnest along z, where it goes on; a sheet along y.
    const Mesh flag = box_mesh({{35e-2, 2e-2, 1e-2}, {35, 2, 1}});
    const auto alone = find_sheet(flag);
    const auto sheet = find_sheet(flag, across_z);
    ASSERT_TRUE(alone);
    ASSERT_TRUE(sheet);
    EXPECT_EQ(alone->layers, 1);
    EXPECT_EQ(sheet->layers, 2);
    EXPECT_EQ(sheet->columns.size(), 35u);
    for (const SurfaceQuad& quad : top_of(*sheet)) {
        for (const int node : quad.node)
            EXPECT_EQ(flag.nodes[static_cast<std::size_t>(node)][1], 2e-2);
    }
}

TEST(BodyThatContinues, has_no_surface_at_its_ends) {
    const Mesh mesh = box_mesh({{3e-2, 2e-2, 1e-2}, {3, 2, 2}});
    const MeshEnds ends(mesh, across_z);
    const auto all = boundary_quads(mesh);
    const auto at_ends =
        std::ranges::count_if(all, [&](const auto& q) { return ends.hold(q); });
    EXPECT_EQ(all.size(), 2u * (6 + 6 + 4));
    EXPECT_EQ(at_ends, 2 * 6);
    const MeshEnds none(mesh, {});
    EXPECT_FALSE(std::ranges::any_of(all, [&](const auto& q) { return none.hold(q); }));
}

TEST(BodyThatContinues, is_no_sheet_with_a_square_section) {
    const Mesh mesh = box_mesh({{2e-2, 2e-2, 1e-3}, {4, 4, 1}});
    EXPECT_TRUE(find_sheet(mesh));
    EXPECT_FALSE(find_sheet(mesh, across_z));
}

}  // namespace
}  // namespace magfsi::structure
