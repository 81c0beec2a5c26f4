// SPDX-License-Identifier: GPL-2.0-or-later
// The stencil of a marker: the cells from which it reads its velocity and to which it
// gives its force, with the same weights both ways. Interpolation and spreading are thus
// adjoint, which conserves power.
//
// The weights are products of one-dimensional regularised delta functions phi(r), r in
// cells. Each has the partition of unity: the sum over the cells of phi(x - i) is 1 for
// every x.
//   two_point    hat function
//   three_point  Roma, Peskin, Berger, J. Comput. Phys. 153 (1999)
//   four_point   Peskin, Acta Numerica 11 (2002), eq. (6.27)
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/options.h"

namespace magfsi::coupler {

// Largest support of a kernel along an axis, in cells.
constexpr int max_support = 4;

// Number of cells that a kernel touches along an axis.
inline int support(Kernel kernel) {
    return 2 + static_cast<int>(kernel);
}

// The cells that a point touches along one axis, first, first + 1, ..., and their
// weights. Cell i has its centre at i + 1/2. Indices may lie outside the box along
// periodic axes.
struct Stencil1D {
    int first = 0;
    int count = 0;
    std::array<double, max_support> weight{};
};

// std::floor without a call or a branch: every marker needs three of them per step.
inline int floor_of(double x) {
    const int toward_zero = x;
    return toward_zero - (x < toward_zero);
}

// Computes all weights at once: by the kernels' own conditions (sum, first moment, sums
// over even and odd cells) they follow from one square root. The result is written in
// place, since a copy would cost as much again.
inline void set_stencil(Stencil1D& s, Kernel kernel, double position_in_cells) {
    s.count = support(kernel);
    const double centred = position_in_cells - 0.5;  // cell i sits at i
    s.first = floor_of(centred - 0.5 * s.count) + 1;
    auto& w = s.weight;
    if (kernel == Kernel::two_point) {
        const double r = centred - s.first;
        w[0] = 1 - r;
        w[1] = r;
    } else if (kernel == Kernel::three_point) {
        const double r = centred - (s.first + 1);
        w[1] = (1 + std::sqrt(1 - 3 * r * r)) * (1.0 / 3);
        w[0] = 0.5 * (1 - w[1] - r);
        w[2] = 0.5 * (1 - w[1] + r);
    } else {
        const double r = centred - (s.first + 1);
        const double root = std::sqrt(1 + 4 * r * (1 - r));
        w[0] = 0.125 * (3 - 2 * r - root);
        w[1] = 0.125 * (3 - 2 * r + root);
        w[2] = 0.125 * (1 + 2 * r + root);
        w[3] = 0.125 * (1 + 2 * r - root);
    }
}

// The stencil in space: the product of three one-dimensional ones. There is no fluid
// beyond a wall: weights there are dropped and the others scaled up, which keeps the
// partition of unity. Across a periodic side indices are wrapped where they are used.
using MarkerStencil = std::array<Stencil1D, 3>;

// Throws Diverged if the point [m] lies outside the box along an axis that is not
// periodic.
void set_stencil(MarkerStencil& stencil, const Grid& grid, Kernel kernel,
                 const Vec3& point_m);
MarkerStencil marker_stencil(const Grid& grid, Kernel kernel, const Vec3& point_m);

// The index wrapped into [0, cells); a kernel wider than the box may need more than one
// turn.
inline int wrapped(int index, int cells) {
    while (index < 0) index += cells;
    while (index >= cells) index -= cells;
    return index;
}

// Cells inside obstacles, which hold no fluid. A marker near one reads from fluid cells
// and gives to fluid cells only: as beyond walls, the weights of solid cells are dropped
// and the others scaled up, which keeps their sum at 1.
class SolidCells {
  public:
    explicit SolidCells(const Grid& grid);

    bool any() const { return !solid_.empty(); }
    // True if the cell is solid; indices lie within the box.
    bool at(int x, int y, int z) const;
    // Sum of the weights in fluid cells. It is exactly 1 if no solid cell has a weight,
    // and 0 if all weights are in solid cells.
    double fluid_share(const MarkerStencil& stencil) const;

  private:
    // False if the stencil certainly touches no solid cell.
    bool may_meet(const MarkerStencil& stencil) const;

    std::array<int, 3> cells_{};
    std::array<int, 3> lo_{}, size_{};  // bounding box of all solid cells
    // One flag per cell of that box, x fastest.
    std::vector<bool> solid_;
};

// A body may stand on an obstacle or reach into it. Markers with less than this share of
// their weights in the fluid lie inside the obstacle, whose wall holds the fluid there;
// they are left out.
constexpr double least_fluid_share = 0.5;

}  // namespace magfsi::coupler
