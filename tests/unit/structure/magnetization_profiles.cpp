#include "structure/magnetics/magnetization.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure/mesh/block_mesh.h"

namespace magfsi::structure {
namespace {

const Mesh strip = box_mesh({{4e-3, 1e-3, 0.2e-3}, {4, 1, 1}});

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
    left.box_m = {Vec3{0, 0, 0}, Vec3{1.9e-3, 1e-3, 1e-3}};
    left.vector_a_m = {1, 0, 0};
    MagneticDomain triangle;  // holds the centres at x = 1.5 and 2.5 mm, y = 0.5 mm
    triangle.polygon_xy_m = {{1e-3, 0}, {3e-3, 0}, {2e-3, 1.5e-3}};
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

TEST(Magnetization, AnElementInNoDomainIsNamedWithItsCentre) {
    MagneticDomain left;
    left.box_m = {Vec3{0, 0, 0}, Vec3{2.6e-3, 1e-3, 1e-3}};
    try {
        domain_magnetization(strip, std::vector<MagneticDomain>{left});
        FAIL() << "nothing thrown";
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("element 3 with its centre at (0.0035, 0.0005, 0.0001)"),
                  std::string::npos)
            << text;
    }
}

TEST(Magnetization, HarmonicRefusesBadProfiles) {
    EXPECT_THROW(harmonic_magnetization(strip, {1, 0, 0, 0, 2}), std::invalid_argument);
    EXPECT_THROW(harmonic_magnetization(strip, {1, 1, 0, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
