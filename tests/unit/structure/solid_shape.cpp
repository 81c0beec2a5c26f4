// SPDX-License-Identifier: GPL-2.0-or-later
// Distances to solid shapes: against points of their surfaces, and their derivatives.
#include "structure/solid_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "structure/mesh/mesh.h"
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
            EXPECT_NEAR(std::hypot(to.normal[0], to.normal[1], to.normal[2]), 1, 1e-14);
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
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{},
                                               {"ball", "0", "0", "0", "0"},
                                               {"ball", "0", "0", "zero", "1"},
                                               {"rod", "0", "0", "0", "1", "w", "1"},
                                               {"rod", "0", "0", "0", "1", "x"},
                                               {"brick", "0", "0", "0", "1", "1", "0"},
                                               {"cone"}})
        EXPECT_THROW(parse_shape(wrong), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
