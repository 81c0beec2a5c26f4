// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/mesh_check.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "structure/lattice/hexahedron.h"
#include "structure/mesh/surface.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Vec3& x, double edge_m) {
    Cell out{};
    for (int d = 0; d < 3; ++d) {
        out[d] = static_cast<std::int64_t>(std::floor(x[d] / edge_m));
    }
    return out;
}

// Renumbers the nodes of named groups and removes those whose new number is negative.
void keep_only(std::map<std::string, std::vector<int>>& groups,
               const std::vector<int>& new_number) {
    for (auto& [name, nodes] : groups) {
        std::vector<int> kept;
        for (const int node : nodes) {
            if (new_number[node] >= 0) kept.push_back(new_number[node]);
        }
        nodes = std::move(kept);
    }
}

// Renumbered element: new local axis d is the old axis[d], reversed if bit d of `flips`
// is set.
Hexahedron renumbered(const Hexahedron& element, const std::array<int, 3>& axis,
                      int flips) {
    Hexahedron out{};
    for (int a = 0; a < 8; ++a) {
        int old = 0;
        for (int d = 0; d < 3; ++d) old |= (((a ^ flips) >> d) & 1) << axis[d];
        out[a] = element[old];
    }
    return out;
}

}  // namespace

int drop_unused_nodes(Mesh& mesh) {
    std::vector<int> new_number(mesh.nodes.size(), -1);
    for (const Hexahedron& element : mesh.elements) {
        for (const int node : element) new_number[node] = 0;
    }
    std::vector<Vec3> kept;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        if (new_number[n] < 0) continue;
        new_number[n] = kept.size();
        kept.push_back(mesh.nodes[n]);
    }
    const auto dropped = mesh.nodes.size() - kept.size();
    mesh.nodes = std::move(kept);
    for (Hexahedron& element : mesh.elements) {
        for (int& node : element) node = new_number[node];
    }
    for (MaterialPoint& point : mesh.centre_line) {
        for (int& node : point.node) node = new_number[node];
    }
    keep_only(mesh.faces, new_number);
    keep_only(mesh.points, new_number);
    return dropped;
}

double shortest_edge_m(const Mesh& mesh) {
    double shortest = INFINITY;
    for (const Hexahedron& element : mesh.elements) {
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) {
                const int b = a | (1 << d);
                if (b == a) continue;
                shortest = std::min(
                    shortest, distance_m(mesh.nodes[element[a]], mesh.nodes[element[b]]));
            }
        }
    }
    return shortest;
}

std::optional<std::array<int, 2>> coincident_nodes(const Mesh& mesh, double tolerance_m) {
    std::vector<std::pair<Cell, int>> cells;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        cells.emplace_back(cell_of(mesh.nodes[n], tolerance_m), static_cast<int>(n));
    }
    std::ranges::sort(cells);
    for (const auto& [cell, node] : cells) {
        for (int c = 0; c < 9; ++c) {
            // Three cells that follow each other along z are neighbours in the sorted
            // list.
            const Cell from{cell[0] + c / 3 - 1, cell[1] + c % 3 - 1, cell[2] - 1};
            auto other = std::ranges::lower_bound(cells, std::pair(from, -1));
            for (; other != cells.end(); ++other) {
                const Cell& at = other->first;
                if (at[0] != from[0] || at[1] != from[1] || at[2] > cell[2] + 1) break;
                const int n = other->second;
                if (n > node &&
                    distance_m(mesh.nodes[n], mesh.nodes[node]) <= tolerance_m) {
                    return std::array{node, n};
                }
            }
        }
    }
    return std::nullopt;
}

std::optional<std::array<int, 2>> duplicate_elements(const Mesh& mesh) {
    std::vector<std::pair<Hexahedron, int>> sorted;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        Hexahedron nodes = mesh.elements[e];
        std::ranges::sort(nodes);
        sorted.emplace_back(nodes, static_cast<int>(e));
    }
    std::ranges::sort(sorted);
    const auto twin = std::ranges::adjacent_find(
        sorted, [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twin == sorted.end()) return std::nullopt;
    return std::array{twin->second, std::next(twin)->second};
}

std::vector<int> connected_parts(const Mesh& mesh) {
    std::vector<int> parent(mesh.nodes.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (const Hexahedron& element : mesh.elements) {
        for (const int node : element) {
            parent[root_of(parent, node)] = root_of(parent, element[0]);
        }
    }
    std::vector<int> number(mesh.nodes.size(), -1);
    std::vector<int> part;
    int parts = 0;
    for (const Hexahedron& element : mesh.elements) {
        int& its = number[root_of(parent, element[0])];
        if (its < 0) its = parts++;
        part.push_back(its);
    }
    return part;
}

std::vector<int> parts_joined_by_faces(const Mesh& mesh) {
    std::vector<int> parent(mesh.elements.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto behind = face_neighbours(mesh);
    for (std::size_t e = 0; e < behind.size(); ++e) {
        for (const FaceOfElement& face : behind[e]) {
            if (face.element >= 0)
                parent[root_of(parent, face.element)] =
                    root_of(parent, static_cast<int>(e));
        }
    }
    std::vector<int> number(parent.size(), -1), part;
    int parts = 0;
    for (std::size_t e = 0; e < parent.size(); ++e) {
        int& its = number[root_of(parent, static_cast<int>(e))];
        if (its < 0) its = parts++;
        part.push_back(its);
    }
    return part;
}

void refuse_broken_mesh(const Mesh& mesh, std::span<const std::size_t> names) {
    const auto name = [&](std::size_t e) {
        return static_cast<int>(names.empty() ? e : names[e]);
    };
    if (mesh.elements.empty())
        refuse("the mesh has no hexahedra; mesh a volume with hexahedra of 8 nodes");
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        integrate_hexahedron(gather(mesh.nodes, mesh.elements[e]), name(e));
    }
    if (const auto twins = duplicate_elements(mesh)) {
        refuse(
            "elements {} and {} of the mesh have the same nodes; put every volume into "
            "one physical group only",
            name((*twins)[0]), name((*twins)[1]));
    }
    if (const auto pair = coincident_nodes(mesh, 1e-3 * shortest_edge_m(mesh))) {
        const Vec3& x = mesh.nodes[(*pair)[0]];
        refuse(
            "two nodes of the mesh coincide at ({:.6g}, {:.6g}, {:.6g}) m: the "
            "parts they belong to touch without being joined; join them (in Gmsh: "
            "Coherence or BooleanFragments before meshing, or Coherence Mesh after it) "
            "or leave a gap between them",
            x[0], x[1], x[2]);
    }
}

Hexahedron lexicographic(const Hexahedron& round) {
    return {round[0], round[1], round[3], round[2],
            round[4], round[5], round[7], round[6]};
}

Hexahedron oriented(const std::vector<Vec3>& nodes_m, const Hexahedron& element) {
    const Eigen::Matrix3d old_axes =
        gather(nodes_m, element).transpose() * shape_gradients({0, 0, 0});
    Hexahedron best = element;
    double closest = -4;  // below the smallest sum of three cosines
    std::array<int, 3> axis{0, 1, 2};
    do {
        for (int flips = 0; flips < 8; ++flips) {
            Eigen::Matrix3d axes;
            for (int d = 0; d < 3; ++d) {
                axes.col(d) = (((flips >> d) & 1) != 0 ? -1 : 1) *
                              old_axes.col(axis[d]).stableNormalized();
            }
            if (!(axes.determinant() > 0) || axes.trace() <= closest) continue;
            closest = axes.trace();
            best = renumbered(element, axis, flips);
        }
    } while (std::next_permutation(axis.begin(), axis.end()));
    return best;
}

}  // namespace magfsi::structure
