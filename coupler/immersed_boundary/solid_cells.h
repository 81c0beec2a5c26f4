// Cells that hold no fluid: obstacles. A marker near one reads from and gives to fluid
// cells alone: as beyond walls, the weights of solid cells are dropped and the rest
// scaled up, which keeps their sum at one.
#pragma once

#include <vector>

#include "coupler/immersed_boundary/marker_stencil.h"

namespace magfsi::coupler {

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
