// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/round_grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "structure/mesh/mesh_check.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

// Half the edge of the core over the radius, and how far its faces bulge towards a ball
// (0: plane): with these no corner of an element is sharper than 45 degrees.
constexpr double core_share = 0.5, bulge = 0.5;

// Numbers the nodes of a grid as elements ask for them. Layers of neighbouring faces
// share the nodes over their common edge.
class GridNodes {
  public:
    GridNodes(Mesh& mesh, const RoundGrid& grid,
              std::function<Vec3(const GridPlace&)> position)
        : mesh_(mesh), grid_(grid), position_(std::move(position)) {}

    int number(const std::array<int, 3>& core, int layer) {
        const auto [at, made] =
            known_.try_emplace({core, layer}, static_cast<int>(mesh_.nodes.size()));
        if (!made) return at->second;
        mesh_.nodes.push_back(position_({core, 1.0 * layer / grid_.layers}));
        if (!grid_.ends && core[0] == 0) mesh_.faces["x_min"].push_back(at->second);
        if (!grid_.ends && core[0] == grid_.core[0])
            mesh_.faces["x_max"].push_back(at->second);
        return at->second;
    }

  private:
    Mesh& mesh_;
    const RoundGrid& grid_;
    std::function<Vec3(const GridPlace&)> position_;
    std::map<std::pair<std::array<int, 3>, int>, int> known_;
};

// Adds the layers over one face of the core; the last layer's outer nodes are a face of
// the mesh.
void add_layers(Mesh& mesh, GridNodes& nodes, const RoundGrid& grid, int d, int side) {
    const int p = (d + 1) % 3, q = (d + 2) % 3;
    std::vector<int>& face =
        mesh.faces[std::string(1, "xyz"[d]) + (side == 0 ? "_min" : "_max")];
    for (int i = 0; i < grid.core[p]; ++i) {
        for (int j = 0; j < grid.core[q]; ++j) {
            for (int l = 0; l < grid.layers; ++l) {
                Hexahedron element{};
                for (int a = 0; a < 8; ++a) {
                    std::array<int, 3> at{};
                    at[d] = side == 0 ? 0 : grid.core[d];
                    at[p] = i + (a & 1);
                    at[q] = j + ((a >> 1) & 1);
                    element[a] = nodes.number(at, l + (a >> 2));
                    if (l + (a >> 2) == grid.layers) face.push_back(element[a]);
                }
                mesh.elements.push_back(oriented(mesh.nodes, element));
            }
        }
    }
}

void sort_faces(Mesh& mesh) {
    for (auto& [name, nodes] : mesh.faces) {
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
}

}  // namespace

Mesh grid_of(const RoundGrid& grid, std::function<Vec3(const GridPlace&)> position) {
    Mesh mesh;
    GridNodes nodes(mesh, grid, std::move(position));
    const auto [nx, ny, nz] = grid.core;
    for (int k = 0; k < nz; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                Hexahedron element{};
                for (int a = 0; a < 8; ++a)
                    element[a] =
                        nodes.number({i + (a & 1), j + ((a >> 1) & 1), k + (a >> 2)}, 0);
                mesh.elements.push_back(oriented(mesh.nodes, element));
            }
        }
    }
    for (int d = grid.ends ? 0 : 1; d < 3; ++d) {
        for (const int side : {0, 1}) add_layers(mesh, nodes, grid, d, side);
    }
    sort_faces(mesh);
    return mesh;
}

Vector3d in_unit_ball(const Vector3d& u, double out) {
    const double largest = u.cwiseAbs().maxCoeff();
    if (largest == 0) return Vector3d::Zero();
    const double shrink = (1 - bulge) + bulge * 1.25 * largest / u.norm();
    const Vector3d inner = core_share * shrink * u;
    if (out == 0) return inner;
    const Vector3d ray =
        (0.25 * std::numbers::pi * u.array()).tan().matrix().normalized();
    return (1 - out) * inner + out * ray;
}

double centred(int i, int cells) {
    return 2.0 * i / cells - 1;
}

void check_round(const char* what, std::initializer_list<double> sizes_m,
                 std::initializer_list<int> counts) {
    for (const double size : sizes_m)
        if (!(size > 0))
            refuse("{} with a size of {:g} m found, it must be positive", what, size);
    for (const int count : counts)
        if (count < 1)
            refuse("{} in {} elements found, at least 1 is needed", what, count);
}

}  // namespace magfsi::structure
