// SPDX-License-Identifier: GPL-2.0-or-later
// The boundary of a hexahedral mesh: its outer quadrilaterals, their areas and points on
// them. Works on any positions of the nodes: pass a mesh with moved nodes for the
// deformed surface.
#pragma once

#include <array>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// One outer face of one element; seen from outside, its nodes run counter-clockwise.
struct SurfaceQuad {
    std::array<int, 4> node{};
    int element = -1;
    int face = -1;  // 2 d + side: the element's side (0 low, 1 high) across direction d
};

// Corners (0 to 7, a = i + 2 j + 4 k) of a face of the reference element, outward.
std::array<int, 4> face_corners(int face);

// Faces that belong to one element only, by element and face number. Throws
// std::invalid_argument that names the elements where a face belongs to more than two.
std::vector<SurfaceQuad> boundary_quads(const Mesh& mesh);

// A face of an element; element -1: none.
struct FaceOfElement {
    int element = -1;
    int face = -1;
};

// What lies behind each of an element's six faces: the same face as its neighbour counts
// it, none at the boundary. Throws as boundary_quads does.
std::vector<std::array<FaceOfElement, 6>> face_neighbours(const Mesh& mesh);

// One face of an element, as SurfaceQuad.
SurfaceQuad outer_quad(const Mesh& mesh, const FaceOfElement& at);

using Corners4 = std::array<Vec3, 4>;  // in cyclic order
Corners4 corners(const std::vector<Vec3>& nodes_m, const std::array<int, 4>& nodes);

// Area [m2] of the bilinear quadrilateral and its vector area, half the cross product of
// the diagonals (exact: it depends on the outline alone).
double quad_area(const Corners4& corners_m);
Vec3 quad_area_vector(const Corners4& corners_m);

// Weights of the four corners at (u, v) in [0, 1]^2, corner 0 at (0, 0), 1 at (1, 0).
std::array<double, 4> quad_shape(double u, double v);

// (u, v) of the point on the quadrilateral nearest to `point_m`: the foot of the
// perpendicular, or the nearest point of the four edges. Exact for plane parallelograms.
std::array<double, 2> nearest_on_quad(const Corners4& corners_m, const Vec3& point_m);

// A cell of a quadrilateral: its middle (u, v), its area and unit normal.
struct QuadCell {
    double u = 0, v = 0;
    double area_m2 = 0;
    Vec3 normal{};
};

// Cuts a quadrilateral into cells of at most `spacing_m` along its edges; areas sum to
// quad_area. Throws std::invalid_argument for a spacing that is not positive.
std::vector<QuadCell> cut_quad(const Corners4& corners_m, double spacing_m);

// How much surface a node stands for [m2]: length of its share of the vector area of the
// boundary, at rest. That is the tributary area on flat parts, that of the mean direction
// at edges and corners (a plain sum would make the edges of a sheet stiffer than its
// middle). Zero for inner nodes.
std::vector<double> surface_areas(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements);

}  // namespace magfsi::structure
