// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/magnetics/magnetization.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "structure/mesh/block_mesh.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const Mesh strip = box_mesh({{4e-3, 1e-3, 0.2e-3}, {4, 1, 1}});

class Table : public testing::Test {
  protected:
    void write(const std::string& text) { std::ofstream(file) << text; }
    std::string refusal() const {
        return test::message_of<std::invalid_argument>(
            [&] { table_magnetization(strip, file); });
    }
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "table.csv";
};

TEST_F(Table, OneRowAnElement) {
    write("# a comment\nMx[kA/m], Mz[A/m], My[A/m]\n1,2,3\n\n4,5,6\n7,8,9\n-1e1,0,0.5\n");
    const auto m = table_magnetization(strip, file);
    ASSERT_EQ(m.size(), 4U);
    EXPECT_EQ(m[0], (Vec3{1e3, 3, 2}));
    EXPECT_EQ(m[3], (Vec3{-1e4, 0.5, 0}));
}

TEST_F(Table, ElementsTakeTheNearestPoint) {
    write(
        "x[mm],y[mm],z[mm],Mx[A/m],My[A/m],Mz[A/m]\n"
        "3.5,0.5,0.1,4,0,0\n0.5,0.5,0.1,1,0,0\n1.9,0.5,0.1,2,0,0\n");
    const auto m = table_magnetization(strip, file);
    EXPECT_EQ(m[0][0], 1);
    EXPECT_EQ(m[1][0], 2);
    EXPECT_EQ(m[2][0], 2);
    EXPECT_EQ(m[3][0], 4);
}

TEST_F(Table, NearestIsThatOfASearchThroughAllPoints) {
    test::Random random(12);
    std::vector<Vec3> points;
    std::string text = "x[m],y[m],z[m],Mx[A/m],My[A/m],Mz[A/m]\n";
    for (int p = 0; p < 300; ++p) {
        points.push_back(
            {random.within(0, 4e-3), random.within(0, 1e-3), random.within(0, 2e-4)});
        text +=
            fmt::format("{},{},{},{},0,0\n", points[p][0], points[p][1], points[p][2], p);
    }
    write(text);
    const Mesh mesh = box_mesh({{4e-3, 1e-3, 0.2e-3}, {16, 4, 2}});
    const auto m = table_magnetization(mesh, file);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const Vec3 centre = element_centre(mesh, e);
        std::size_t best = 0;
        for (std::size_t p = 1; p < points.size(); ++p) {
            if (test::distance(points[p], centre) < test::distance(points[best], centre))
                best = p;
        }
        EXPECT_EQ(m[e][0], static_cast<double>(best));
    }
}

TEST_F(Table, ErrorsNameTheLineAndWhatIsAllowed) {
    const std::string header = "Mx[A/m],My[A/m],Mz[A/m]\n";
    const std::pair<std::string, std::string> wrong[] = {
        {"", "no header"},
        {"Mx,My,Mz\n", "line 1: column \"Mx\" found with the unit \"\"; [A/m], [kA/m]"},
        {"Mx[G],My[A/m],Mz[A/m]\n", "line 1: column \"Mx[G]\""},
        {"Mx[A/m],My[A/m]\n", "the columns Mx, My, Mz are needed"},
        {"x[m],Mx[A/m],My[A/m],Mz[A/m]\n", "all or none of x, y, z"},
        {"Mx[A/m],Mx[A/m],Mz[A/m]\n", "column Mx found twice"},
        {"B[A/m],My[A/m],Mz[A/m]\n", "column \"B[A/m]\" found, x, y, z, Mx, My, Mz"},
        {header, "no row found"},
        {header + "1,2\n", "line 2: 2 values found, 3 are needed"},
        {header + "1,2,3\n1,two,3\n", "line 3: \"two\" found"},
        {header + "1,2,nan\n", "line 2: \"nan\" found"},
        {header + "1,2,\n", "line 2: \"\" found"},
        {header + "1,2,3\n", "1 rows found for 4 elements"},
        {"x[m],y[m],z[m],Mx[A/m],My[A/m],Mz[A/m]\n0.5,0.5,0.1,1,0,0\n",
         "element 0 with the centre (0.0005, 0.0005, 0.0001) m"}};
    for (const auto& [text, expected] : wrong) {
        write(text);
        test::expect_says(refusal(), {expected});
        test::expect_says(refusal(), {file.string()});
    }
    std::filesystem::remove(file);
    test::expect_says(refusal(), {"cannot open"});
}

TEST(RegionMagnetization, EachElementHasTheVectorOfItsRegion) {
    const Mesh plate = oblique_mesh({2, 1, 1, 1, 1.2, 0.1, {2, 2, 1}});
    const auto m = region_magnetization(
        plate, {{"row 0 column 0", {1, 0, 0}}, {"row 0 column 1", {0, 2, 0}}});
    for (std::size_t e = 0; e < m.size(); ++e) {
        EXPECT_EQ(m[e], (plate.region[e] == 0 ? Vec3{1, 0, 0} : Vec3{0, 2, 0}));
    }
    EXPECT_THROW(region_magnetization(plate, {{"row 0 column 0", {}}}),
                 std::invalid_argument);
    EXPECT_THROW(region_magnetization(plate, {{"row 0 column 0", {}},
                                              {"row 0 column 1", {}},
                                              {"row 0 column 2", {}}}),
                 std::invalid_argument);
    EXPECT_THROW(region_magnetization(strip, {}), std::invalid_argument);
}

TEST(Magnetization, HarmonicTurnsOnceAWavelengthFromTheLeftEnd) {
    Mesh moved = strip;
    for (Vec3& node : moved.nodes) node[0] += 1.0;  // s starts at the body's end
    const double phase = std::numbers::pi / 4;
    const auto m = harmonic_magnetization(moved, {62e3, 4e-3, phase, 0, 2});
    ASSERT_EQ(m.size(), 4U);
    // Centres at s = 1/8, 3/8, 5/8, 7/8 of the wavelength: angles 90, 180, 270, 360
    // degrees.
    const double expected[4][2] = {{0, 62e3}, {-62e3, 0}, {0, -62e3}, {62e3, 0}};
    for (int e = 0; e < 4; ++e) {
        EXPECT_NEAR(m[e][0], expected[e][0], 1e-6);  // coordinates near 1 m: 1e-16/4e-3
        EXPECT_EQ(m[e][1], 0);
        EXPECT_NEAR(m[e][2], expected[e][1], 1e-6);
    }
}

TEST(Magnetization, FirstDomainThatHoldsACentreWins) {
    MagneticDomain left;
    left.shape.box_m = {Vec3{0, 0, 0}, Vec3{1.9e-3, 1e-3, 1e-3}};
    left.vector_a_m = {1, 0, 0};
    MagneticDomain triangle;  // holds the centres at x = 1.5 and 2.5 mm, y = 0.5 mm
    triangle.shape.polygon_xy_m = {{1e-3, 0}, {3e-3, 0}, {2e-3, 1.5e-3}};
    triangle.vector_a_m = {0, 2, 0};
    MagneticDomain rest;
    rest.vector_a_m = {0, 0, 3};
    const std::vector<MagneticDomain> domains{left, triangle, rest};
    const auto m = domain_magnetization(strip, domains);
    EXPECT_EQ(m[0], (Vec3{1, 0, 0}));
    EXPECT_EQ(m[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(m[2], (Vec3{0, 2, 0}));
    EXPECT_EQ(m[3], (Vec3{0, 0, 3}));
}

TEST(Magnetization, AnElementInNoDomainCarriesNone) {
    MagneticDomain left;
    left.shape.box_m = {Vec3{0, 0, 0}, Vec3{2.6e-3, 1e-3, 1e-3}};
    left.vector_a_m = {1, 0, 0};
    const auto m = domain_magnetization(strip, std::vector<MagneticDomain>{left});
    EXPECT_EQ(m[2], (Vec3{1, 0, 0}));
    EXPECT_EQ(m[3], (Vec3{}));
    // The second one has all its elements taken by the first.
    EXPECT_THROW(domain_magnetization(strip, std::vector<MagneticDomain>{left, left}),
                 std::invalid_argument);
}

TEST(Magnetization, HarmonicRefusesBadProfiles) {
    EXPECT_THROW(harmonic_magnetization(strip, {1, 0, 0, 0, 2}), std::invalid_argument);
    EXPECT_THROW(harmonic_magnetization(strip, {1, 1, 0, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
