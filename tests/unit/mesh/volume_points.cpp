// Points through the volume of a body and their depth below its surface.
#include "structure/mesh/body_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/mesh/block_mesh.h"
#include "structure/mesh/sheet.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.6e-3}, {3, 2, 1}};

TEST(VolumePoints, share_out_the_body) {
    Mesh mesh = box_mesh(box);
    for (Vec3& x : mesh.nodes) x[0] *= 1 + 200 * x[1] + 100 * x[2];  // no bricks any more
    double sum = 0;
    const auto points = volume_points(mesh, 0.25e-3);
    for (const auto& p : points) sum += p.volume_m3;
    EXPECT_GT(points.size(), 3U * 2 * 3 * 4 * 2);
    EXPECT_NEAR(sum / volume_m3(mesh), 1, 1e-13);  // rounding of a hundred volumes
}

TEST(VolumePoints, are_spaced_by_at_most_what_is_asked) {
    const auto points = volume_points(box_mesh(box), 0.25e-3);
    EXPECT_EQ(points.size(), 6U * 4 * 2 * 3);  // 1 mm, 0.5 mm, 0.6 mm in 4, 2, 3 parts
    EXPECT_THROW(volume_points(box_mesh(box), 0), std::invalid_argument);
}

TEST(Depths, of_points_in_a_block) {
    const Mesh mesh = box_mesh(box);
    std::vector<MaterialPoint> points;
    std::vector<double> expected;
    constexpr double limit = 0.25e-3;
    for (const auto& p : volume_points(mesh, 0.2e-3)) {
        points.push_back(p.point);
        const Vec3 x = position(mesh, p.point);
        double least = limit;
        for (int d = 0; d < 3; ++d) least = std::min({least, x[d], box.size_m[d] - x[d]});
        expected.push_back(least);
    }
    constexpr double spacing = 0.02e-3;
    const auto found = depths(mesh, boundary_quads(mesh), points, spacing, limit);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_GE(found[i], expected[i] * (1 - 1e-12));
        // Half the diagonal of four surface points off to the side.
        EXPECT_LE(found[i],
                  std::hypot(expected[i], spacing / std::sqrt(2.0)) * (1 + 1e-12));
    }
}

TEST(Sheet, points_below_a_face_end_at_the_middle) {
    const Mesh mesh = box_mesh({{3e-3, 1e-3, 0.2e-3}, {6, 3, 3}});
    const auto sheet = find_sheet(mesh);
    ASSERT_TRUE(sheet);
    const auto height = [&](SheetSide side, double depth) {
        const auto points = points_below_face(mesh, *sheet, side, depth, 1e-3);
        return position(mesh, points.front().point)[2];
    };
    EXPECT_NEAR(height(SheetSide::top, 0), 0.2e-3, 1e-18);
    EXPECT_NEAR(height(SheetSide::bottom, 0), 0, 1e-18);
    EXPECT_NEAR(height(SheetSide::top, 0.03e-3), 0.17e-3, 1e-18);
    EXPECT_NEAR(height(SheetSide::bottom, 0.08e-3), 0.08e-3, 1e-18);
    EXPECT_NEAR(height(SheetSide::top, 1), 0.1e-3, 1e-18);
    EXPECT_EQ(rim_of(mesh, *sheet).size(), 3U * 2 * (6 + 3));
}

}  // namespace
}  // namespace magfsi::structure
