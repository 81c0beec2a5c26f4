// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid shapes that bodies cannot enter, represented by their signed distance. SI.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "structure/options.h"
#include "structure/triangle_surface.h"

namespace magfsi::structure {

// Sphere.
struct Ball {
    Vec3 centre_m{};
    double radius_m = 0;
};
// Cylinder along a coordinate axis (0 x, 1 y, 2 z).
struct Rod {
    Vec3 centre_m{};
    double radius_m = 0;
    int axis = 2;
    std::optional<double> half_length_m;  // absent: infinitely long
};
// Box along the coordinate axes.
struct Brick {
    Vec3 low_m{}, high_m{};  // opposite corners
};
// Solid inside a closed triangle surface. A point x of the file lies at shift_m + unit_m
// x.
struct Surface {
    std::string file;
    double unit_m = 1;
    Vec3 shift_m{};
    // Shared by all copies of the shape
    std::shared_ptr<const TriangleSurface> triangles;
};
// Reads the file. Throws std::invalid_argument as the constructor of TriangleSurface
// does, and if the path cannot be written as one word of a LAMMPS line.
Surface read_surface(const std::string& file, double unit_m, const Vec3& shift_m);
using SolidShape = std::variant<Ball, Rod, Brick, Surface>;

// Distance of a point to the nearest point of a shape's surface, negative inside, and the
// outward unit vector there. Where several points are nearest (middle of a ball, axis of
// a rod) it is one of them; on a triangle surface itself the normal is that of the file.
struct SignedDistance {
    double distance_m = 0;
    Vec3 normal{};
};
SignedDistance signed_distance(const SolidShape& shape, const Vec3& point_m);
// The same for a shape that is repeated: distance to the nearest image. period_m: length
// of the period along each axis, 0 along axes without one.
SignedDistance signed_distance(const SolidShape& shape, const Vec3& point_m,
                               const Vec3& period_m);

// A shape as words of a LAMMPS command, and back: "ball X Y Z RADIUS", "rod X Y Z RADIUS
// x|y|z HALF_LENGTH|inf", "brick X Y Z X Y Z" or "surface FILE UNIT X Y Z", lengths in
// metres. parse_shape throws std::invalid_argument if the words are no shape.
std::string shape_words(const SolidShape& shape);
SolidShape parse_shape(const std::vector<std::string>& words);
// Number of words of a shape of this name, the name included; 0 if there is no such
// shape.
int shape_word_count(const std::string& name);

}  // namespace magfsi::structure
