// What a fluid on a uniform grid offers to the coupling. A new fluid backend implements
// this and joins through the same immersed boundary and exchange as every other.
#pragma once

#include <span>

#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

class GridFluid {
  public:
    virtual ~GridFluid() = default;

    // The same on all ranks.
    virtual const Grid& grid() const = 0;

    // Velocity [m/s] in cells of this rank, three values a cell, row after row: the state
    // before the coming step's force acts.
    virtual void velocity(std::span<const GridRow> rows, std::span<double> out) = 0;

    // Force density [N/m3] of the coming step only.
    virtual void set_force(std::span<const GridRow> rows,
                           std::span<const double> density) = 0;

    // One coupled step.
    virtual void advance() = 0;

    // For schemes that repeat a step: keep() notes the state between two steps, in
    // memory; go_back() returns to it from the step's end, as often as is wanted. Between
    // go_back() and the next advance() only set_force() is called, in the same rows. A
    // fluid without these can take part in the other schemes only.
    virtual void keep();
    virtual void go_back();
};

}  // namespace magfsi::coupler
