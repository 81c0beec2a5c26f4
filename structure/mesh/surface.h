// SPDX-License-Identifier: GPL-2.0-or-later
// Boundary of a hexahedral mesh: its outer quads, their areas and points on them. All
// functions work on any positions of the nodes: a mesh with moved nodes gives the
// deformed surface.
#pragma once

#include <array>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Outer face of an element. Its nodes run counter-clockwise as seen from outside.
struct SurfaceQuad {
    std::array<int, 4> node{};
    int element = -1;
    int face = -1;  // 2 d + side: low (0) or high (1) end of local direction d
};

// Corners of a face of the reference element, numbers a = i + 2 j + 4 k, in outward
// order.
std::array<int, 4> face_corners(int face);

// Faces that belong to one element only, sorted by element and face number. Throws
// std::invalid_argument, with the elements, if a face belongs to more than two.
std::vector<SurfaceQuad> boundary_quads(const Mesh& mesh);

// A face of an element; element is -1 for none.
struct FaceOfElement {
    int element = -1;
    int face = -1;
};

// Neighbour at each of an element's six faces: the same face as a face of the neighbour,
// none at the boundary. Throws as boundary_quads does.
std::vector<std::array<FaceOfElement, 6>> face_neighbours(const Mesh& mesh);

// A face of an element as a SurfaceQuad.
SurfaceQuad outer_quad(const Mesh& mesh, const FaceOfElement& at);

using Corners4 = std::array<Vec3, 4>;  // in cyclic order
// Positions of four nodes.
Corners4 corners(const std::vector<Vec3>& nodes_m, const std::array<int, 4>& nodes);

// Area [m2] of a bilinear quad, and its vector area, half the cross product of the
// diagonals, which is exact, as it depends on the outline only.
double quad_area(const Corners4& corners_m);
Vec3 quad_area_vector(const Corners4& corners_m);

// Weights of the four corners at (u, v) in [0, 1]^2, with corner 0 at (0, 0) and corner 1
// at (1, 0).
std::array<double, 4> quad_shape(double u, double v);

// Coordinates (u, v) of the point of the quad nearest to `point_m`: the foot of the
// perpendicular, or the nearest point of the four edges. Exact for plane parallelograms.
std::array<double, 2> nearest_on_quad(const Corners4& corners_m, const Vec3& point_m);

// Cell of a quad: its middle (u, v), area and unit normal.
struct QuadCell {
    double u = 0, v = 0;
    double area_m2 = 0;
    Vec3 normal{};
};

// Cells of at most spacing_m along the edges of a quad, whose areas sum to quad_area.
// Throws std::invalid_argument on a spacing that is not positive.
std::vector<QuadCell> cut_quad(const Corners4& corners_m, double spacing_m);

// Surface share of each node [m2], undeformed: the length of its share of the boundary's
// vector area. On flat parts it is the tributary area; at edges and corners it is that of
// the mean direction, as a plain sum would make the edges of a sheet stiffer than its
// middle. Zero for inner nodes.
std::vector<double> surface_areas(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements);

}  // namespace magfsi::structure
