// SPDX-License-Identifier: GPL-2.0-or-later
// The effects (effects.inc) that the configuration asks for at the six sides of this
// rank's box. Half-way bounce-back is not among them: the sweep does it.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/obstacle/obstacles.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

// An effect at one side of this rank's box; its functions are called in each step.
class SideEffect {
  public:
    virtual ~SideEffect() = default;
    // Called before the sweep; arrangement: the one before the step. Outlets note here
    // what enters in the coming step.
    virtual void before_sweep(const Populations&, Arrangement) {}
    // Called after the exchange, when a population that meets a side is bounced back.
    // Free slip reflects it; walls and inlets add their terms. At an edge of two sides it
    // is reflected first. Collective among neighbours. time: middle of the step, in
    // steps.
    virtual void after_exchange(const Populations&, const RowLayout&, double /*time*/) {}
    // Called at the end of the step; arrangement: the new one. Outlets rebuild their
    // cells.
    virtual void end_step(const Populations&, Arrangement) {}
};

// Input of the functions that make effects. The objects referred to must outlive the
// effects.
struct SideContext {
    MPI_Comm comm;
    const FluidConfig& config;
    const Decomposition& decomposition;
    int rank;
    const Populations& populations;
    const RowLayout& layout;
    const SolidMap* solids;  // solid cells; null if the box has no obstacles

    const CellBox& owned() const { return decomposition.boxes[rank]; }
    // This rank's cells at a side, in local indices; absent if its box does not reach the
    // side.
    std::optional<CellBox> cells_at(int side) const {
        return cells_at_side(owned(), config.cells, side);
    }
};

// Type of make_NAME_effect, which each effect defines: makes the effect for a side that
// asks for it, null where this rank has no part in the side. Throws
// std::invalid_argument, on all ranks alike.
using MakeSideEffect = std::unique_ptr<SideEffect> (*)(const SideContext&, int side);

// Makes the effects of all sides, in the order of effects.inc. Throws
// std::invalid_argument on all ranks if one has an outlet but no cell behind it, or if a
// side asks for an effect that is not in this build.
std::vector<std::unique_ptr<SideEffect>> make_side_effects(const SideContext& context);

}  // namespace magfsi::fluid
