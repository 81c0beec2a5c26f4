// SPDX-License-Identifier: GPL-2.0-or-later
// What the coupling needs to know of a fluid: a uniform grid of cells with values at the
// cell centres, cut into one box per rank, and what can be done with it. SI.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "grid/cells.h"

namespace magfsi::coupler {

using Vec3 = std::array<double, 3>;

// The numbers of a container of Vec3, one after the other.
template <class Vectors>
auto flat(Vectors&& v) {
    return std::span(v.empty() ? nullptr : v.front().data(), 3 * v.size());
}

using magfsi::CellBox;
using GridRow = magfsi::CellRow;

// When the two sides look anew which marker is near which rank: before the first coupled
// step and before the steps n with (n + ahead) % every = 0. No marker may move further
// than the margin in between.
struct Renewal {
    int every = 5;
    int ahead = 0;
    int margin_cells = 2;  // 0.4 cells a step, all that the lattice allows
};

struct Grid {
    double spacing_m = 0;
    std::array<int, 3> cells{};
    std::array<bool, 3> periodic{};
    // Boxes of each rank, further from each other than a kernel is wide: one, but in a
    // grid that follows the bodies one for each part of it around them, and beyond
    // periodic sides where it crosses them. None is empty.
    std::vector<std::vector<CellBox>> owned_by_rank;
    bool follows = false;
    Renewal renewal{};
    std::vector<GridRow> solid{};  // cells without fluid, of all ranks
};

// As text, for the partner at start-up.
std::string to_text(const Grid& grid);
Grid grid_from_text(const std::string& text);

// A fluid on a uniform grid. A new fluid backend implements this and joins through the
// same immersed boundary and exchange as every other.
class GridFluid {
  public:
    virtual ~GridFluid() = default;

    // The same on all ranks.
    virtual const Grid& grid() const = 0;

    // Velocity [m/s] in cells of this rank, three values per cell, row after row: the
    // state before the coming step's force acts. relative_density: one value per cell,
    // the density over that at rest (1 in an incompressible fluid); empty unless forcing
    // without slip needs it.
    virtual void velocity(std::span<const GridRow> rows, std::span<double> out,
                          std::span<double> relative_density) = 0;

    // Force density [N/m3] of the coming step only.
    virtual void set_force(std::span<const GridRow> rows,
                           std::span<const double> density) = 0;

    // One coupled step.
    virtual void advance() = 0;

    // Where grid().follows: before a renewal, with a box [m] around the markers of each
    // body. The grid's boxes may be others afterwards. Collective.
    virtual void follow(const std::vector<std::array<Vec3, 2>>& /*bodies_m*/) {}

    // For schemes that repeat a step: keep() notes the state between two steps, in
    // memory; go_back() returns to it from the step's end, as often as is wanted. Between
    // go_back() and the next advance() only velocity() and set_force() are
    // called, in the same rows. A fluid without these can take part in the other schemes
    // only.
    virtual void keep();
    virtual void go_back();
};

}  // namespace magfsi::coupler
