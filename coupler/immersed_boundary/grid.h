// SPDX-License-Identifier: GPL-2.0-or-later
// The coupling's view of a fluid: a uniform grid of cells with values at the cell
// centres, divided into boxes of the ranks, and the operations on it. All quantities are
// in SI units.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/grid/cells.h"
#include "base/vector/vec3.h"

namespace magfsi::coupler {

using magfsi::Vec3;

// View of a container of Vec3 as one list of numbers.
template <class Vectors>
auto flat(Vectors&& v) {
    return std::span(v.empty() ? nullptr : v.front().data(), 3 * v.size());
}

using magfsi::CellBox;
using GridRow = magfsi::CellRow;

// Occasions at which the two sides determine anew which markers are near which rank:
// before the first coupled step, and before the steps n with (n + ahead) % every = 0. No
// marker may move further than the margin in between.
struct Renewal {
    int every = 5;
    int ahead = 0;
    int margin_cells = 2;  // 0.4 cells per step, the limit of lattice speeds
};

// The cells of a fluid, the same on all ranks of both sides. Cell (0, 0, 0) has a corner
// at the origin.
struct Grid {
    double spacing_m = 0;
    std::array<int, 3> cells{};
    std::array<bool, 3> periodic{};  // by axis
    // Boxes of each rank, further from each other than a kernel is wide. A rank has one
    // box; in a grid that follows the bodies it has one for each part of the grid around
    // them, and further ones beyond periodic sides that the part crosses. No box is
    // empty.
    std::vector<std::vector<CellBox>> owned_by_rank;
    bool follows = false;  // the grid moves with the bodies
    Renewal renewal{};
    std::vector<GridRow> solid{};  // rows of cells inside obstacles, of all ranks
};

// The grid as JSON, for the partner at start-up. grid_from_text throws nlohmann::json's
// exceptions on a text that is none.
std::string to_text(const Grid& grid);
Grid grid_from_text(const std::string& text);

// The interface that a fluid solver on a uniform grid offers to the coupling. Every
// backend joins through the same immersed boundary and exchange. All calls are made by
// all ranks of the fluid.
class GridFluid {
  public:
    virtual ~GridFluid() = default;

    // The description of the grid, the same on all ranks.
    virtual const Grid& grid() const = 0;

    // Reads the velocity [m/s] in cells of this rank before the coming step's force acts,
    // three values per cell, row after row. relative_density: one value per cell, the
    // density over that at rest (1 in an incompressible fluid); empty unless forcing
    // no_slip needs it.
    virtual void velocity(std::span<const GridRow> rows, std::span<double> out,
                          std::span<double> relative_density) = 0;

    // Sets the force density [N/m3] of the coming step only, three values per cell, row
    // after row; replaces what was set before.
    virtual void set_force(std::span<const GridRow> rows,
                           std::span<const double> density) = 0;

    // Advances by one coupled step.
    virtual void advance() = 0;

    // Lets a grid that follows the bodies move; called before each renewal with a box [m]
    // around the markers of each body. The boxes of grid() may be others afterwards.
    // Collective.
    virtual void follow(const std::vector<std::array<Vec3, 2>>& /*bodies_m*/) {}

    // For schemes that repeat a step. keep() stores the state between two steps in
    // memory; go_back() returns to it from the step's end, any number of times. Between
    // go_back() and the next advance() only velocity() and set_force() are called, with
    // the same rows. The defaults throw std::invalid_argument: such a fluid can take part
    // in the serial scheme only.
    virtual void keep();
    virtual void go_back();
};

}  // namespace magfsi::coupler
