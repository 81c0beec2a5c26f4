// SPDX-License-Identifier: GPL-2.0-or-later
// Hexahedral mesh of one body in the body's own frame. Lengths in [m].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "structure/options.h"

namespace magfsi::structure {

// Node numbers of a hexahedron in lexicographic order: local node a = i + 2 j + 4 k is at
// the low (0) or high (1) end of local directions 0, 1, 2 for i, j, k. Right-handed.
using Hexahedron = std::array<int, 8>;

inline double distance_m(const Vec3& a, const Vec3& b) {
    return norm(a - b);
}

// Point fixed to an element: its position is the sum of weight[a] * x[node[a]].
struct MaterialPoint {
    std::array<int, 8> node{};
    std::array<double, 8> weight{};
    int element = -1;  // number of the element; -1: none
};

// Mesh in the undeformed state.
struct Mesh {
    std::vector<Vec3> nodes;
    std::vector<Hexahedron> elements;
    // Node numbers of named faces, "x_min" and others
    std::map<std::string, std::vector<int>> faces;
    // Points from the left to the right end; may be empty
    std::vector<MaterialPoint> centre_line;

    // Regions carry materials and magnetisations. region[e] is the index of element e's
    // region in region_names. Both are empty for a mesh without regions.
    std::vector<int> region;
    std::vector<std::string> region_names;
    // Share of each element that is solid, in meshes of cubes; empty if all are whole.
    // Above 1 where a cube also stands for omitted neighbours.
    std::vector<double> solid_share;
    // Node numbers of named points and lines, ascending, for probes.
    std::map<std::string, std::vector<int>> points;
};

// Position of a material point in the undeformed mesh.
inline Vec3 position(const Mesh& mesh, const MaterialPoint& point) {
    Vec3 x{};
    for (std::size_t a = 0; a < 8; ++a) x += point.weight[a] * mesh.nodes[point.node[a]];
    return x;
}

// Mean of an element's nodes [m].
inline Vec3 element_centre(const Mesh& mesh, std::size_t element) {
    Vec3 centre{};
    for (const int node : mesh.elements[element]) centre += 0.125 * mesh.nodes[node];
    return centre;
}

// Axis-parallel bounding box [m]; empty at first.
struct Bounds {
    Vec3 low_m{INFINITY, INFINITY, INFINITY};
    Vec3 high_m{-INFINITY, -INFINITY, -INFINITY};

    void add(const Vec3& x) {
        low_m = lower(low_m, x);
        high_m = higher(high_m, x);
    }
    // True for points in the box or at most margin_m outside.
    bool holds(const Vec3& x, double margin_m = 0) const {
        return distance_m(x) <= margin_m;
    }
    // Distance of a point outside from the box; 0 inside.
    double distance_m(const Vec3& x) const {
        Vec3 gap{};
        for (int d = 0; d < 3; ++d) {
            gap[d] = std::max({0.0, low_m[d] - x[d], x[d] - high_m[d]});
        }
        return norm(gap);
    }
    // True if the boxes overlap or touch.
    bool meets(const Bounds& other) const {
        for (int d = 0; d < 3; ++d) {
            if (low_m[d] > other.high_m[d] || other.low_m[d] > high_m[d]) return false;
        }
        return true;
    }
    Vec3 extent_m() const { return high_m - low_m; }
    double diagonal_m() const { return norm(extent_m()); }
};

// Bounding box of all nodes, or of the nodes `which`.
inline Bounds bounds(const std::vector<Vec3>& nodes_m) {
    Bounds out;
    for (const Vec3& x : nodes_m) out.add(x);
    return out;
}
inline Bounds bounds(const std::vector<Vec3>& nodes_m, std::span<const int> which) {
    Bounds out;
    for (const int node : which) out.add(nodes_m[node]);
    return out;
}

}  // namespace magfsi::structure
