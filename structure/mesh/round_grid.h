// SPDX-License-Identifier: GPL-2.0-or-later
// Grids of round bodies: a core of blocks with layers of elements from its faces to the
// surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <initializer_list>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// A point of the grid: indices in the core, or of a point of its surface, and how far it
// is from there to the outer surface, 0 to 1.
struct GridPlace {
    std::array<int, 3> core{};
    double out = 0;
};

// Core of core[0] x core[1] x core[2] cells, with layers on its faces along y and z, and
// along x if `ends`.
struct RoundGrid {
    std::array<int, 3> core{};
    int layers = 1;
    bool ends = false;
};

// The mesh of a grid whose points are where `position` puts them. Without `ends` the
// faces x_min and x_max are the two ends of core and layers.
Mesh grid_of(const RoundGrid& grid, std::function<Vec3(const GridPlace&)> position);

// Place in a ball or, with u[0] = 0, in a disc of radius 1: u from -1 to 1 along each
// axis of the core, `out` from the core to the surface. Points of the surface are at
// equal angles.
Eigen::Vector3d in_unit_ball(const Eigen::Vector3d& u, double out);

// Place of a core index from -1 to 1.
double centred(int i, int cells);

// Refuses sizes and numbers that are not positive.
void check_round(const char* what, std::initializer_list<double> sizes_m,
                 std::initializer_list<int> counts);

}  // namespace magfsi::structure
