// SPDX-License-Identifier: GPL-2.0-or-later
// The cells that a marker reads its velocity from and gives its force to: the same
// weights both ways, so that power is conserved (interpolation and spreading are
// adjoint).
//
// The weights are products of one-dimensional regularised delta functions phi(r), r in
// cells. Each has the partition of unity: sum over the cells of phi(x - i) = 1 for every
// x.
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

constexpr int max_support = 4;

inline int support(Kernel kernel) {
    return 2 + static_cast<int>(kernel);
}

// The cells that a point touches along one axis: first, first + 1, ... with their
// weights. A cell i has its centre at i + 1/2.
struct Stencil1D {
    int first = 0;
    int count = 0;
    std::array<double, max_support> weight{};
};

// Without a call or a branch: every marker needs three of them a step.
inline int floor_of(double x) {
    const int toward_zero = x;
    return toward_zero - (x < toward_zero);
}

// All weights at once: by the kernels' own conditions (sum, first moment, even and odd
// cells) they follow from one root. Into its place, for a copy costs as much again.
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

// Product of three one-dimensional stencils. Beyond a wall there is no fluid: those
// weights are dropped and the rest scaled up, which keeps the partition of unity. Across
// a periodic side the indices wrap when used.
using MarkerStencil = std::array<Stencil1D, 3>;

// Throws Diverged when the point lies outside a box without periodic sides.
void set_stencil(MarkerStencil& stencil, const Grid& grid, Kernel kernel,
                 const Vec3& point_m);
MarkerStencil marker_stencil(const Grid& grid, Kernel kernel, const Vec3& point_m);

// Index wrapped into [0, cells): more than once where a kernel is wider than the box.
inline int wrapped(int index, int cells) {
    while (index < 0) index += cells;
    while (index >= cells) index -= cells;
    return index;
}

// Cells that hold no fluid: obstacles. A marker near one reads from and gives to fluid
// cells alone: as beyond walls, the weights of solid cells are dropped and the rest
// scaled up, which keeps their sum at one.
class SolidCells {
  public:
    explicit SolidCells(const Grid& grid);

    bool any() const { return !solid_.empty(); }
    // Indices within the box.
    bool at(int x, int y, int z) const;
    // Sum of the weights in fluid cells: 1, and that exactly, where no solid one has any;
    // 0 where all have.
    double fluid_share(const MarkerStencil& stencil) const;

  private:
    bool may_meet(const MarkerStencil& stencil) const;

    std::array<int, 3> cells_{};
    std::array<int, 3> lo_{}, size_{};  // of the box around all solid cells
    std::vector<bool> solid_;
};

// A body may stand on an obstacle or reach into it. Markers that have less than this
// share of their weights in the fluid lie in the obstacle, whose wall holds the fluid
// there: they take no part.
constexpr double least_fluid_share = 0.5;

}  // namespace magfsi::coupler
