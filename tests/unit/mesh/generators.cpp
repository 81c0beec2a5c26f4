// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>
#include "structure/mesh/block_mesh.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/mesh_check.h"
#include "structure/mesh/mesh_file.h"
#include "structure/mesh/sheet.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Box box{{3e-3, 1e-3, 0.2e-3}, {6, 3, 2}};

TEST(BoxMesh, ElementsFillTheBox) {
    const Mesh mesh = box_mesh(box);
    EXPECT_EQ(mesh.nodes.size(), 7U * 4 * 3);
    EXPECT_EQ(mesh.elements.size(), 36U);
    EXPECT_NEAR(volume_m3(mesh) / 0.6e-9, 1, 1e-13);  // rounding of 36 volumes
}

TEST(BoxMesh, FacesHoldTheNodesOfTheirPlanes) {
    const Mesh mesh = box_mesh(box);
    ASSERT_EQ(mesh.faces.size(), 6U);
    EXPECT_EQ(mesh.faces.at("x_min").size(), 12U);
    EXPECT_EQ(mesh.faces.at("y_max").size(), 21U);
    EXPECT_EQ(mesh.faces.at("z_max").size(), 28U);
    for (int node : mesh.faces.at("x_max")) EXPECT_DOUBLE_EQ(mesh.nodes[node][0], 3e-3);
    for (int node : mesh.faces.at("z_min")) EXPECT_EQ(mesh.nodes[node][2], 0);
}

TEST(BoxMesh, CentreLineRunsFromLeftToRightAtHalfWidthAndThickness) {
    const Mesh mesh = box_mesh(box);
    ASSERT_EQ(mesh.centre_line.size(), 7U);
    for (std::size_t i = 0; i < 7; ++i) {
        const Vec3 x = position(mesh, mesh.centre_line[i]);
        EXPECT_NEAR(x[0], 0.5e-3 * static_cast<double>(i), 1e-17);
        EXPECT_NEAR(x[1], 0.5e-3, 1e-17);
        EXPECT_NEAR(x[2], 0.1e-3, 1e-17);
    }
}

TEST(BoxMesh, PointsOutsideAreMovedToTheSurface) {
    const Mesh mesh = box_mesh(box);
    const Vec3 x = position(mesh, locate(box, {-1, 0.4e-3, 5}));
    EXPECT_NEAR(x[0], 0, 1e-17);
    EXPECT_NEAR(x[1], 0.4e-3, 1e-17);
    EXPECT_NEAR(x[2], 0.2e-3, 1e-17);
}

ObliquePlate miura() {
    return {4, 3, 5e-3, 6e-3, std::numbers::pi / 3, 1e-3, {5, 6, 2}};
}

TEST(ObliqueMesh, FillsThePlateWithValidElements) {
    const ObliquePlate plate = miura();
    const Mesh mesh = oblique_mesh(plate);  // volume_m3() refuses inverted elements
    const double cell = 5e-3 * 6e-3 * std::sin(std::numbers::pi / 3) * 1e-3;
    EXPECT_NEAR(volume_m3(mesh) / (12 * cell), 1, 1e-12);  // rounding of 720 elements
}

TEST(ObliqueMesh, CellBordersAreElementBorders) {
    const ObliquePlate plate = miura();
    const Mesh mesh = oblique_mesh(plate);
    ASSERT_EQ(mesh.region.size(), mesh.elements.size());
    ASSERT_EQ(mesh.region_names.size(), 12U);
    EXPECT_EQ(mesh.region_names[7], "row 1 column 3");
    const double lean = std::cos(plate.angle_rad) * plate.length_b_m;
    const double height = std::sin(plate.angle_rad) * plate.length_b_m;
    std::vector<double> volume(12, 0.0);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const int row = mesh.region[e] / 4, column = mesh.region[e] % 4;
        volume[mesh.region[e]] +=
            integrate_hexahedron(gather(mesh.nodes, mesh.elements[e]), 0).volume;
        for (const int node : mesh.elements[e]) {
            const Vec3& x = mesh.nodes[node];
            const double v = x[1] / height - row;  // 0 to 1 in the cell
            const double shift = lean * (row % 2 == 0 ? v : 1 - v);
            const double u = (x[0] - shift) / plate.length_a_m - column;
            for (const double s : {u, v}) {
                EXPECT_GT(s, -1e-12);  // rounding
                EXPECT_LT(s, 1 + 1e-12);
            }
        }
    }
    for (const double v : volume) EXPECT_NEAR(v / volume[0], 1, 1e-12);
}

TEST(ObliqueMesh, FacesAndCentreLineAreNamedAsThoseOfABlock) {
    const Mesh mesh = oblique_mesh(miura());
    EXPECT_EQ(mesh.faces.at("x_min").size(), 19U * 3);
    EXPECT_EQ(mesh.faces.at("y_max").size(), 21U * 3);
    EXPECT_EQ(mesh.faces.at("z_min").size(), 21U * 19);
    ASSERT_EQ(mesh.centre_line.size(), 21U);
    // Half way up row 1: half the lean.
    const Vec3 x = position(mesh, mesh.centre_line.front());
    EXPECT_NEAR(x[0], 1.5e-3, 1e-15);
    EXPECT_NEAR(x[2], 0.5e-3, 1e-15);
}

TEST(ObliqueMesh, WithoutZigzagIsAShearedBlock) {
    ObliquePlate plate = miura();
    plate.zigzag = false;
    const Mesh mesh = oblique_mesh(plate);
    const Vec3& corner = mesh.nodes[20 + 21 * 18];  // i = 20, j = 18, k = 0
    EXPECT_NEAR(corner[0], 4 * 5e-3 + 3 * 3e-3, 1e-15);
}

TEST(ObliqueMesh, ARightAngleGivesABlock) {
    ObliquePlate plate = miura();
    plate.angle_rad = std::numbers::pi / 2;
    const Mesh block = box_mesh({{20e-3, 18e-3, 1e-3}, {20, 18, 2}});
    const Mesh mesh = oblique_mesh(plate);
    ASSERT_EQ(mesh.elements, block.elements);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        EXPECT_LT(test::distance(mesh.nodes[n], block.nodes[n]), 1e-16);  // cos(pi/2)
    }
}

TEST(BlockMesh, RefusesEmptyBoxesAndPlates) {
    EXPECT_THROW(box_mesh({{1, 1, 1}, {1, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(box_mesh({{1, -1, 1}, {1, 1, 1}}), std::invalid_argument);
    for (const double angle : {0.0, std::numbers::pi, -1.0, double(NAN)}) {
        ObliquePlate plate = miura();
        plate.angle_rad = angle;
        EXPECT_THROW(oblique_mesh(plate), std::invalid_argument) << angle;
    }
    ObliquePlate none = miura();
    none.cells[1] = 0;
    EXPECT_THROW(oblique_mesh(none), std::invalid_argument);
    none = miura();
    none.thickness_m = 0;
    EXPECT_THROW(oblique_mesh(none), std::invalid_argument);
}

TEST(MeshFile, ReadsBackExactly) {
    Mesh mesh = oblique_mesh({2, 2, 1.0 / 3, 0.7, 1, 0.1, {2, 2, 1}});
    mesh.region_names[0] = "#1 steel";
    mesh.points["the tip"] = {3};
    mesh.points["centre_line"] = {4, 0, 2, 1, 3};
    const test::TemporaryFolder folder;
    const auto file = folder / "test.mesh";
    write_mesh_file(mesh, file);
    const Mesh read = read_mesh_file(file);
    EXPECT_EQ(read.nodes, mesh.nodes);
    EXPECT_EQ(read.elements, mesh.elements);
    EXPECT_EQ(read.region, mesh.region);
    EXPECT_EQ(read.region_names, mesh.region_names);
    EXPECT_EQ(read.faces, mesh.faces);
    EXPECT_EQ(read.points, mesh.points);
    ASSERT_EQ(read.centre_line.size(), 5U);
    for (int i = 0; i < 5; ++i) {  // in order of x, whatever the order in the file
        EXPECT_EQ(position(read, read.centre_line[i]), mesh.nodes[i]);
    }
}

TEST(MeshFile, ABlockHasNoRegions) {
    const test::TemporaryFolder folder;
    const auto file = folder / "block.mesh";
    write_mesh_file(box_mesh({{1, 1, 1}, {2, 1, 1}}), file);
    const Mesh read = read_mesh_file(file);
    EXPECT_TRUE(read.region.empty() && read.region_names.empty());
    EXPECT_EQ(read.elements.size(), 2U);
}

TEST(MeshFile, ErrorsNameFileLineAndWhatWasExpected) {
    const test::TemporaryFolder folder;
    const auto file = folder / "wrong.mesh";
    const std::string nodes = "nodes 1\n0 0 0\nregions 0\n";
    const std::pair<std::string, std::string> wrong[] = {
        {"knots 1\n", "line 1: expected \"nodes N\""},
        {"nodes 1\n0 0\n", "line 2: expected three coordinates of a node; found 0 0"},
        {nodes + "elements 1\n0 0 0 0 0 0 0 1 -1\n", "line 5: expected numbers of nodes"},
        {nodes + "elements 1\n0 0 0 0 0 0 0 0 0\n", "line 5: expected eight node"},
        {nodes, "line 3: expected \"elements N\""},
        {nodes + "elements 0\nfaces 1\nmany top\n", "line 6: expected the count"}};
    for (const auto& [text, expected] : wrong) {
        std::ofstream(file) << text;
        test::expect_refusal<std::runtime_error>([&] { read_mesh_file(file); },
                                                 {file.string() + ", " + expected});
    }
    EXPECT_THROW(read_mesh_file(file), std::runtime_error);
}

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

// Points in the middle of the thickness, deeper than which none lie.
std::vector<SurfacePoint> mid_surface_points(const Mesh& mesh, const Sheet& sheet,
                                             double spacing_m) {
    return points_below_face(mesh, sheet, SheetSide::top, INFINITY, spacing_m);
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
