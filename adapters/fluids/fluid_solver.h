// SPDX-License-Identifier: GPL-2.0-or-later
// What a fluid participant asks of its solver beyond the coupling's GridFluid.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/immersed_boundary/grid.h"
#include "coupler/output/summary.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::fluids {

using FluidTotals = fluid::Totals;  // without sound where the solver has none
using fluid::PlaneFlow;

// Cells of one size, in their own global indices.
struct FieldCells {
    std::string name;  // goes into those of files; empty, or "_level1"
    double spacing_m = 0;
    std::vector<coupler::CellBox> owned_by_rank;  // some may be empty
    // Of those, the ones that a finer level has instead.
    std::vector<coupler::CellBox> hidden;
};

class FluidSolver : public coupler::GridFluid {
  public:
    // One line on what runs: cells, step, method.
    virtual std::string headline() const = 0;

    // For probes; each is collective. The last two are asked of solvers alone for which
    // scenes may have obstacles and planes.
    virtual FluidTotals totals() = 0;
    // Of the quantities that are none of the totals.
    virtual double quantity(scene::FluidQuantity quantity) = 0;
    virtual std::vector<scene::Vec3> obstacle_forces() { return {}; }
    virtual PlaneFlow plane_flow(int /*axis*/, double /*at_m*/) { return {}; }

    // The cells of fields in files: grid()'s, or those of each patch of a refined grid.
    virtual std::vector<FieldCells> field_cells() const {
        FieldCells all{"", grid().spacing_m, {}, {}};
        for (const auto& boxes : grid().owned_by_rank)
            all.owned_by_rank.push_back(boxes.front());
        return {all};
    }
    // Of this rank's cells of a patch, x fastest: 3 values a cell, density 1. Collective.
    virtual void field(scene::FluidField field, std::size_t patch,
                       std::span<float> out) = 0;

    // Throws coupler::Diverged.
    virtual void check_divergence() = 0;

    // Cells, method; what it has waited for its own neighbours.
    virtual output::FluidSummary summary() const = 0;
    virtual output::Named<std::string> versions() const { return {}; }
    virtual double waited_for_neighbours_s() const { return 0; }
    // Below, a rank has too little to do.
    virtual std::int64_t min_cells_per_rank() const { return 20000; }

    // The flow's part of a checkpoint. Collective; file is null but on the root.
    virtual void save(coupler::StateWriter* file) = 0;
    virtual void restore(const coupler::StateReader& file) = 0;
};

}  // namespace magfsi::fluids
