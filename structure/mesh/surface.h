// The boundary of a hexahedral mesh: its outer quadrilaterals and their areas. Works on
// any positions of the nodes: pass a mesh with moved nodes for the deformed surface.
#pragma once

#include <array>
#include <span>
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

// Area [m2] of the bilinear quadrilateral and its vector area, half the cross product of
// the diagonals (exact: it depends on the outline alone).
double quad_area(const std::vector<Vec3>& nodes_m, const SurfaceQuad& quad);
Vec3 quad_area_vector(const std::vector<Vec3>& nodes_m, const SurfaceQuad& quad);

// Tributary area of each node [m2]: integral of its shape function over the boundary;
// sums to the surface's area. One value a node, zero for inner nodes.
std::vector<double> surface_node_area(const Mesh& mesh);

// Edges of the surface that are not shared by exactly two quads: empty for a closed
// surface without contact along an edge (two parts that meet in one edge only).
std::vector<std::array<int, 2>> irregular_edges(std::span<const SurfaceQuad> surface);

}  // namespace magfsi::structure
