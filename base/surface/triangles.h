// SPDX-License-Identifier: GPL-2.0-or-later
// Closed surfaces of triangles from STL files, shared by the obstacles of the fluid and
// the surfaces that push bodies back. Both sides include this header, and neither the
// other.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vector/vec3.h"

namespace magfsi::surface {

// Corners, in the unit of the file or of the caller's scale.
using Triangle = std::array<Vec3, 3>;

// A closed surface. Seen from outside, its triangles run counter-clockwise. Their winding
// numbers add up, and a point is inside where the sum is not 0, so that parts may
// overlap.
struct Closed {
    std::vector<Triangle> triangles;
    int parts = 1;  // number of surfaces that share no edge
};

// Reads a closed surface from an STL file, ASCII or binary; a point x of the file moves
// to shift + scale * x. Vertices within 1e-7 of the surface's size are joined. Parts that
// are inside out are turned, except for cavities. Throws std::invalid_argument, "is the
// STL file NAME, which ...", if the file cannot be read, is cut short, has no triangle or
// is not closed.
Closed read_closed(const std::string& file, double scale, const Vec3& shift);

// Normal of a triangle by the right hand; its length is twice the area.
inline Vec3 normal(const Triangle& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}

// Crossing of a line along x with a triangle: its place, and +1 where the line comes out
// of the surface, -1 where it goes in.
struct Crossing {
    double x = 0;
    int out = 0;
};
// The crossing of the line along x at (y, z) with a triangle, if there is one. Each edge
// is evaluated in one order of its ends, so that both triangles of an edge agree and a
// line through an edge or a corner is counted once.
std::optional<Crossing> crossing(const Triangle& triangle, double y, double z);

}  // namespace magfsi::surface
