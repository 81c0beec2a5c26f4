#include "structure/mesh/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "structure/mesh/mesh_check.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Box strip{{3.7e-3, 1.5e-3, 0.185e-3}, {20, 8, 3}};

double area(const std::vector<SurfacePoint>& points) {
    double sum = 0;
    for (const SurfacePoint& point : points) sum += point.area_m2;
    return sum;
}

// Numbers the corners of every other element along other axes.
Mesh shuffled(Mesh mesh) {
    for (std::size_t e = 0; e < mesh.elements.size(); e += 2) {
        const Hexahedron h = mesh.elements[e];
        mesh.elements[e] = {h[0], h[2], h[4], h[6], h[1], h[3], h[5], h[7]};
    }
    return mesh;
}

void expect_strip(const Mesh& mesh, const Sheet& sheet) {
    EXPECT_EQ(sheet.layers, 3);
    EXPECT_EQ(sheet.columns.size(), 160U);
    std::set<int> elements;
    for (const SheetColumn& column : sheet.columns) {
        elements.insert(column.elements.begin(), column.elements.end());
        EXPECT_GT(quad_area_vector(corners(mesh.nodes, column.top.node))[2], 0);
        EXPECT_LT(quad_area_vector(corners(mesh.nodes, column.bottom.node))[2], 0);
        for (int a = 0; a < 4; ++a) {
            for (int level = 0; level < 4; ++level) {
                const Vec3& x = mesh.nodes[column.levels[level][a]];
                EXPECT_NEAR(x[2], 0.185e-3 * level / 3, 1e-17);
                EXPECT_EQ(x[0], mesh.nodes[column.levels[0][a]][0]);
            }
        }
    }
    EXPECT_EQ(elements.size(), mesh.elements.size());
    // Rounding of 160 areas.
    const auto points = mid_surface_points(mesh, sheet, 1e-4);
    EXPECT_NEAR(area(points) / (3.7e-3 * 1.5e-3), 1, 1e-12);
    for (const SurfacePoint& point : points) {
        EXPECT_NEAR(position(mesh, point.point)[2], 0.0925e-3, 1e-17);
        EXPECT_NEAR(point.normal[2], 1, 1e-14);
    }
}

TEST(Sheet, AStripHasColumnsAndAMidSurface) {
    const Mesh mesh = box_mesh(strip);
    const auto sheet = find_sheet(mesh);
    ASSERT_TRUE(sheet);
    expect_strip(mesh, *sheet);
}

TEST(Sheet, DoesNotDependOnTheNumberingOfTheCorners) {
    const Mesh mesh = shuffled(box_mesh(strip));
    const auto sheet = find_sheet(mesh);
    ASSERT_TRUE(sheet);
    expect_strip(mesh, *sheet);
}

TEST(Sheet, MidSurfaceHalvesUnequalLayers) {
    Mesh mesh = box_mesh(strip);
    for (Vec3& x : mesh.nodes) x[2] = std::pow(x[2] / 0.185e-3, 2) * 0.185e-3;
    const auto sheet = find_sheet(mesh);
    ASSERT_TRUE(sheet);
    for (const SurfacePoint& p : mid_surface_points(mesh, *sheet, 1)) {
        EXPECT_NEAR(position(mesh, p.point)[2], 0.0925e-3, 1e-17);  // rounding
    }
}

TEST(Sheet, ABentSheetAndAnObliquePlateAreSheets) {
    Mesh bent = box_mesh(strip);
    // Rolled up to three quarters of a circle: its faces look in all directions.
    const double radius = 3.7e-3 / (1.5 * M_PI);
    for (Vec3& x : bent.nodes) {
        const double angle = x[0] / radius, r = radius - x[2];
        x = {r * std::sin(angle), x[1], -r * std::cos(angle)};
    }
    const auto sheet = find_sheet(bent);
    ASSERT_TRUE(sheet);
    EXPECT_EQ(sheet->columns.size(), 160U);
    const double mid_length = 3.7e-3 * (1 - 0.0925e-3 / radius);
    // Chords instead of an arc: (13.5 degrees)^2 / 24.
    EXPECT_NEAR(area(mid_surface_points(bent, *sheet, 1)) / (mid_length * 1.5e-3), 1,
                3e-3);

    const Mesh plate = oblique_mesh({4, 3, 5e-3, 6e-3, M_PI / 3, 1e-3, {2, 2, 2}});
    ASSERT_TRUE(find_sheet(plate));
    EXPECT_EQ(find_sheet(plate)->columns.size(), 48U);
}

TEST(Sheet, OnARingTheOuterSideIsTheTop) {
    // A tube: 24 elements round, 6 along, 1 across; its ends joined.
    Mesh tube = box_mesh({{24, 6, 1}, {24, 6, 1}});
    std::vector<int> number(tube.nodes.size());
    for (std::size_t n = 0; n < number.size(); ++n) {
        Vec3& x = tube.nodes[n];
        number[n] = static_cast<int>(x[0] > 23.5 ? n - 24 : n);
        const double angle = x[0] / 24 * 2 * M_PI, r = 6 - x[2];
        x = {-r * std::sin(angle), x[1], -r * std::cos(angle)};
    }
    for (Hexahedron& element : tube.elements) {
        for (int& node : element) node = number[node];
        element = oriented(tube.nodes, element);
    }
    ASSERT_GT(volume_m3(tube), 0);
    const auto sheet = find_sheet(tube);
    ASSERT_TRUE(sheet);
    double top = 0, bottom = 0;
    for (const SheetColumn& column : sheet->columns) {
        top += quad_area(corners(tube.nodes, column.top.node));
        bottom += quad_area(corners(tube.nodes, column.bottom.node));
    }
    EXPECT_NEAR(top / bottom, 6.0 / 5, 1e-12);  // rounding of 144 areas
}

TEST(Sheet, CubesAndTwoSheetsAreNot) {
    EXPECT_FALSE(find_sheet(box_mesh({{1, 1, 1}, {1, 1, 1}})));
    EXPECT_FALSE(find_sheet(box_mesh({{1, 1, 1}, {4, 4, 4}})));
    Mesh two = box_mesh({{4, 4, 0.1}, {4, 4, 1}});
    std::erase_if(two.elements, [&](const Hexahedron& element) {
        return two.nodes[element[0]][0] == 2;  // a gap between x = 2 and 3
    });
    EXPECT_FALSE(find_sheet(two));
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

// A body that spans a periodic box has no surface at its two ends there.
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
    for (const SheetColumn& column : sheet->columns) {
        for (const int node : column.top.node) EXPECT_EQ(flag.nodes[node][1], 2e-2);
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
