// SPDX-License-Identifier: GPL-2.0-or-later
// Solid shapes that bodies cannot enter, by their distance.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "structure/options.h"
#include "structure/triangle_surface.h"

namespace magfsi::structure {

struct Ball {
    Vec3 centre_m{};
    double radius_m = 0;
};
// Along a coordinate axis, 0 x, 1 y, 2 z.
struct Rod {
    Vec3 centre_m{};
    double radius_m = 0;
    int axis = 2;
    std::optional<double> half_length_m;  // without end
};
struct Brick {
    Vec3 low_m{}, high_m{};  // opposite corners
};
// What a closed surface of triangles holds; a point x of its file is at shift + unit * x.
struct Surface {
    std::string file;
    double unit_m = 1;
    Vec3 shift_m{};
    std::shared_ptr<const TriangleSurface> triangles;
};
// Throws as TriangleSurface, and on a path that no line of LAMMPS can have.
Surface read_surface(const std::string& file, double unit_m, const Vec3& shift_m);
using SolidShape = std::variant<Ball, Rod, Brick, Surface>;

// Where a point is to a shape: the distance to the nearest point of its surface, negative
// inside, and there the unit vector outwards. On the middle of a ball or the axis of a
// rod, where all directions are as near, one of them; on a surface of triangles itself
// the normal that its file has.
struct SignedDistance {
    double distance_m = 0;
    Vec3 normal{};
};
SignedDistance signed_distance(const SolidShape& shape, const Vec3& point_m);
// To the nearest of its images, of axes along which it is there again, else 0.
SignedDistance signed_distance(const SolidShape& shape, const Vec3& point_m,
                               const Vec3& period_m);

// "ball X Y Z RADIUS", "rod X Y Z RADIUS x|y|z HALF_LENGTH|inf", "brick X Y Z X Y Z" or
// "surface FILE UNIT X Y Z", lengths in metres, and back. Throws std::invalid_argument on
// what is no shape.
std::string shape_words(const SolidShape& shape);
SolidShape parse_shape(const std::vector<std::string>& words);
// How many words a shape of this name has, itself included; 0: there is none.
int shape_word_count(const std::string& name);

}  // namespace magfsi::structure
