// Hexahedral mesh of one body, in the body's own frame [m].
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace magfsi::structure {

using Vec3 = std::array<double, 3>;

// Node numbers of one hexahedron in lexicographic order: a = i + 2 j + 4 k, i, j, k in
// {0,1}.
using Hexahedron = std::array<int, 8>;

// A point carried by an element: position = sum of weight[a] * x[node[a]].
struct MaterialPoint {
    std::array<int, 8> node{};
    std::array<double, 8> weight{};
    int element = -1;
};

struct Mesh {
    std::vector<Vec3> nodes;
    std::vector<Hexahedron> elements;
    std::map<std::string, std::vector<int>> faces;  // "x_min" ...: node numbers
    std::vector<MaterialPoint> centre_line;         // left end to right end; may be empty

    // Regions carry materials and magnetisations: region[e] is a place in region_names.
    // Both are empty for a mesh of one piece.
    std::vector<int> region;
    std::vector<std::string> region_names;
    // Named points and lines for probes: node numbers, ascending.
    std::map<std::string, std::vector<int>> points;
};

// Where a material point lies in the undeformed mesh.
inline Vec3 position(const Mesh& mesh, const MaterialPoint& point) {
    Vec3 x{};
    for (std::size_t a = 0; a < 8; ++a) {
        const Vec3& node = mesh.nodes[static_cast<std::size_t>(point.node[a])];
        for (std::size_t d = 0; d < 3; ++d) x[d] += point.weight[a] * node[d];
    }
    return x;
}

}  // namespace magfsi::structure
