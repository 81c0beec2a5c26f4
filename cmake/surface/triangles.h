// SPDX-License-Identifier: GPL-2.0-or-later
// Closed surfaces of triangles from STL files: what an obstacle of the fluid and what
// pushes bodies back have in common. Both sides see this header, and neither the other.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace magfsi::surface {

using Point = std::array<double, 3>;
using Triangle = std::array<Point, 3>;

// A closed surface: from outside, triangles run counter-clockwise, and in space their
// windings add up: a point is inside where they are not 0, so that parts may overlap.
struct Closed {
    std::vector<Triangle> triangles;
    int parts = 1;  // surfaces that share no edge
};

// ASCII or binary; a point x of the file comes to shift + scale * x. Vertices within 1e-7
// of the size are one. Parts that are turned inside out are turned back, but for
// cavities. Throws std::invalid_argument, "is the STL file NAME, which ...", if the file
// cannot be read, is cut short, has no triangle or is not closed.
Closed read_closed(const std::string& file, double scale, const Point& shift);

inline Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross_product(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0]};
}
// Of twice the area.
inline Point normal(const Triangle& t) {
    return cross_product(minus(t[1], t[0]), minus(t[2], t[0]));
}

// Where the line along x at (y, z) meets the triangle, none where it does not, and
// whether it comes out there (+1) or goes in (-1). Each edge is met in one order of its
// ends, so that triangles that share it agree and a line through an edge or a corner is
// counted once.
struct Crossing {
    double x = 0;
    int out = 0;
};
std::optional<Crossing> crossing(const Triangle& triangle, double y, double z);

}  // namespace magfsi::surface
