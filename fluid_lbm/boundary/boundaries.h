// SPDX-License-Identifier: GPL-2.0-or-later
// Everything at the six sides of this rank's box besides half-way bounce-back, which the
// sweep does itself: the effects of effects.inc that the configuration asks for.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/obstacle/obstacles.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

// What an effect does at one side of this rank's box in each step.
class SideEffect {
  public:
    virtual ~SideEffect() = default;
    // Outlets note what enters in the coming step.
    virtual void before_sweep(const Populations&, Arrangement) {}
    // What leaves an edge of two sides is reflected, then gains the terms of walls and
    // inlets. Collective among neighbours. time: steps.
    virtual void after_exchange(const Populations&, const RowLayout&, double /*time*/) {}
    // In the new arrangement: outlets rebuild their cells.
    virtual void end_step(const Populations&, Arrangement) {}
};

// What effects are made from; all of it outlives them.
struct SideContext {
    MPI_Comm comm;
    const FluidConfig& config;
    const Decomposition& decomposition;
    int rank;
    const Populations& populations;
    const RowLayout& layout;
    const SolidMap* solids;  // null without obstacles

    const CellBox& owned() const { return decomposition.boxes[rank]; }
    // This rank's cells at a side, local indices; none if its box does not reach there.
    std::optional<CellBox> cells_at(int side) const {
        return cells_at_side(owned(), config.cells, side);
    }
};

// make_NAME_effect of each effect: for a side that asks for it; null where this rank has
// no part in it. Throws std::invalid_argument, on all ranks alike.
using MakeSideEffect = std::unique_ptr<SideEffect> (*)(const SideContext&, int side);

// Throws std::invalid_argument on all ranks if one has an outlet but no cell behind it,
// or if a side asks for what is not in this build. In the order of effects.inc.
std::vector<std::unique_ptr<SideEffect>> make_side_effects(const SideContext& context);

}  // namespace magfsi::fluid
