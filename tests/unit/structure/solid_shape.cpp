// SPDX-License-Identifier: GPL-2.0-or-later
// Distances to solid shapes: against points of their surfaces, and their derivatives.
#include "structure/solid_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "structure/mesh/mesh.h"
#include "tests/support/checks.h"
#include "tests/support/stl_surfaces.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

const std::vector<SolidShape> shapes{
    Ball{{0.2, -0.1, 0.4}, 0.7}, Rod{{0.1, 0.3, -0.2}, 0.6, 1, 0.8},
    Rod{{0.1, 0.3, -0.2}, 0.6, 0, {}}, Brick{{-0.5, -0.4, -0.9}, {0.7, 0.6, 0.3}}};

std::vector<Vec3> random_points(int count) {
    test::Random random(3);
    std::vector<Vec3> points(static_cast<std::size_t>(count));
    for (Vec3& x : points)
        for (double& value : x) value = 1.5 * random.uniform();
    return points;
}

Vec3 moved(const Vec3& x, double by, const Vec3& along) {
    return {x[0] + by * along[0], x[1] + by * along[1], x[2] + by * along[2]};
}

// The foot of the way to the surface is on it, the way has the distance's length, and no
// other point of the surface, of which there is one on each of many ways, is nearer.
TEST(SolidShape, DistanceIsThatOfTheNearestPointOfTheSurface) {
    for (const SolidShape& shape : shapes) {
        std::vector<Vec3> surface;
        for (const Vec3& x : random_points(4000)) {
            const SignedDistance to = signed_distance(shape, x);
            surface.push_back(moved(x, -to.distance_m, to.normal));
            EXPECT_NEAR(signed_distance(shape, surface.back()).distance_m, 0, 1e-14);
            EXPECT_NEAR(norm(to.normal), 1, 1e-14);
        }
        for (const Vec3& x : random_points(200)) {
            const double distance = std::abs(signed_distance(shape, x).distance_m);
            for (const Vec3& point : surface)
                EXPECT_GE(distance_m(x, point), distance * (1 - 1e-12));
        }
    }
}

TEST(SolidShape, NormalIsTheDerivativeOfTheDistance) {
    int inside = 0, points = 0;
    for (const SolidShape& shape : shapes) {
        for (const Vec3& x : random_points(200)) {
            const SignedDistance here = signed_distance(shape, x);
            inside += here.distance_m < 0 ? 1 : 0;
            const double step = 1e-7;
            // Not across the middle of a body, where the nearest side changes.
            const Vec3& n = here.normal;
            const double along = (signed_distance(shape, moved(x, step, n)).distance_m -
                                  signed_distance(shape, moved(x, -step, n)).distance_m) /
                                 (2 * step);
            const Vec3 across{n[1] - n[2], n[2] - n[0], n[0] - n[1]};
            const double beside =
                (signed_distance(shape, moved(x, step, across)).distance_m -
                 signed_distance(shape, moved(x, -step, across)).distance_m) /
                (2 * step);
            EXPECT_NEAR(along, 1, 1e-7);
            EXPECT_NEAR(beside, 0, 1e-6);
            ++points;
        }
    }
    EXPECT_GT(inside, points / 20);
}

TEST(SolidShape, IsReadFromItsWords) {
    for (const SolidShape& shape : shapes) {
        std::istringstream text(shape_words(shape));
        std::vector<std::string> words;
        for (std::string word; text >> word;) words.push_back(word);
        EXPECT_EQ(static_cast<int>(words.size()), shape_word_count(words[0]));
        EXPECT_EQ(shape_words(parse_shape(words)), shape_words(shape));
    }
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
             {},
             {"ball", "0", "0", "0", "0"},
             {"ball", "0", "0", "zero", "1"},
             {"rod", "0", "0", "0", "1", "w", "1"},
             {"rod", "0", "0", "0", "1", "x"},
             {"brick", "0", "0", "0", "1", "1", "0"},
             {"surface", "none.stl", "1", "0", "0"},
             {"surface", "none.stl", "1", "0", "0", "0"},
             {"cone"}})
        EXPECT_THROW(parse_shape(wrong), std::invalid_argument);
}

// --- surfaces of triangles

class Triangulated : public ::testing::Test {
  protected:
    // The file is half as large, and shifted.
    Surface of(magfsi::test::Triangles triangles) {
        for (auto& triangle : triangles)
            for (auto& x : triangle)
                for (double& value : x) value = 2 * (value - 0.25);
        magfsi::test::write_stl(file_, triangles);
        return read_surface(file_, 0.5, {0.25, 0.25, 0.25});
    }
    magfsi::test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "surface.stl";
};

// Where the nearest point of the surface is one alone.
TEST_F(Triangulated, BrickIsTheBrick) {
    const Brick brick{{-0.5, -0.4, -0.9}, {0.7, 0.6, 0.3}};
    auto triangles = magfsi::test::brick_surface(brick.low_m, brick.high_m);
    for (int turned = 0; turned < 2; ++turned) {
        const Surface surface = of(triangles);
        EXPECT_EQ(
            shape_words(parse_shape({"surface", file_, "0.5", "0.25", "0.25", "0.25"})),
            shape_words(surface));
        for (const Vec3& x : random_points(4000)) {
            const SignedDistance expected = signed_distance(brick, x);
            const SignedDistance found = signed_distance(surface, x);
            EXPECT_NEAR(found.distance_m, expected.distance_m, 1e-15);
            // Rounding of the point on the surface over the way to it.
            for (std::size_t d = 0; d < 3; ++d)
                EXPECT_NEAR(found.normal[d], expected.normal[d],
                            1e-15 / std::abs(expected.distance_m));
        }
        // Turned inside out it holds the same.
        for (auto& triangle : triangles) std::swap(triangle[0], triangle[1]);
    }
}

// A facet lies within the ball by its sagitta.
TEST_F(Triangulated, BallConvergesAtSecondOrder) {
    const Ball ball{{0.2, -0.1, 0.4}, 0.7};
    std::vector<double> error;
    for (const int n : {8, 16, 32}) {
        const Surface surface =
            of(magfsi::test::ball_surface(ball.centre_m, ball.radius_m, n));
        double mean = 0;
        for (const Vec3& x : random_points(2000))
            mean += std::abs(signed_distance(surface, x).distance_m -
                             signed_distance(ball, x).distance_m) /
                    2000;
        error.push_back(mean);
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.15);
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.15);
}

// A wall between two balls, of which one, turned inside out, is within the other: the
// tree finds what looking at all triangles does, and neither is the hole held.
TEST_F(Triangulated, NearestOfAllAndAHole) {
    auto triangles = magfsi::test::ball_surface({0, 0, 0}, 1, 6);
    auto hole = magfsi::test::ball_surface({0.1, 0, 0}, 0.6, 5);
    for (auto& triangle : hole) std::swap(triangle[0], triangle[1]);
    triangles.insert(triangles.end(), hole.begin(), hole.end());
    const Surface surface = of(triangles);
    int held = 0;
    for (const Vec3& x : random_points(2000)) {
        const SignedDistance to = signed_distance(surface, x);
        const double r = norm(x);
        const double from_hole = std::hypot(x[0] - 0.1, x[1], x[2]);
        if (r < 0.95 && from_hole > 0.62) {
            EXPECT_LT(to.distance_m, 0);
            ++held;
        }
        if (r > 1 || from_hole < 0.56) {
            EXPECT_GT(to.distance_m, 0);
        }
        const double nearest = std::min(std::abs(r - 1), std::abs(from_hole - 0.6));
        EXPECT_NEAR(std::abs(to.distance_m), nearest, 0.05);
        // On the surface, and the normal is the derivative.
        const Vec3 foot = moved(x, -to.distance_m, to.normal);
        EXPECT_NEAR(signed_distance(surface, foot).distance_m, 0, 1e-15);
    }
    EXPECT_GT(held, 100);
}

TEST_F(Triangulated, AnyPathIsAWordOfAScript) {
    const auto path = folder_ / "m\u00fc\u00df 100% $x & #1 'a\".stl";
    of(magfsi::test::brick_surface({0, 0, 0}, {1, 1, 1}));
    std::filesystem::rename(file_, path);
    const std::string text = shape_words(read_surface(path, 1, {}));
    EXPECT_EQ(text.find_first_of("$&#\"'\n"), std::string::npos);
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    EXPECT_EQ(std::get<Surface>(parse_shape(words)).file, path.string());
    magfsi::test::expect_says(
        magfsi::test::message_of([&] { read_surface("/none.stl", 1, {}); }),
        {"/none.stl", "cannot be opened"});
}

}  // namespace
}  // namespace magfsi::structure
