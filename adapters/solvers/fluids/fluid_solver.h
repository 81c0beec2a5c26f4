// SPDX-License-Identifier: GPL-2.0-or-later
// The interface of a fluid solver to its participant: probes, fields, checkpoints and the
// summary, beyond the coupling's GridFluid.
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

// Integrals over the fluid. The sound energy is 0 for solvers of incompressible flow.
using FluidTotals = fluid::Totals;
using fluid::PlaneFlow;

// A block of cells of one size, written as one image: the whole grid, or one patch of a
// refined grid. Boxes are half-open, in global cell indices of that size.
struct FieldCells {
    std::string name;  // part of the file names: empty, or "_level1" and the like
    double spacing_m = 0;
    // Box of each rank, by rank; some may be empty.
    std::vector<coupler::CellBox> owned_by_rank;
    // Cells of these boxes that a finer patch solves instead; pictures hide them.
    std::vector<coupler::CellBox> hidden;
};

// A fluid solver as the participant drives it. All calls are made by every rank.
class FluidSolver : public coupler::GridFluid {
  public:
    // One line for the log that describes the run: cells, time step, method.
    virtual std::string headline() const = 0;

    // Values for probes, collective, the same on every rank. obstacle_forces() and
    // plane_flow() are called only for solvers whose scenes may have obstacles and
    // planes.
    virtual FluidTotals totals() = 0;
    // A scalar that is not one of the totals, in the unit of its column.
    virtual double quantity(scene::FluidQuantity quantity) = 0;
    // Force of the fluid on each obstacle [N], in the scene's order.
    virtual std::vector<scene::Vec3> obstacle_forces() { return {}; }
    // Flow through the plane across `axis` at the coordinate at_m [m].
    virtual PlaneFlow plane_flow(int /*axis*/, double /*at_m*/) { return {}; }

    // The blocks of cells that field files are written from: the one of grid(), or one
    // for each patch of a refined grid.
    virtual std::vector<FieldCells> field_cells() const {
        FieldCells all{"", grid().spacing_m, {}, {}};
        for (const auto& boxes : grid().owned_by_rank)
            all.owned_by_rank.push_back(boxes.front());
        return {all};
    }
    // Fills `out` with a field at this rank's cells of a patch (index into
    // field_cells()), x fastest, then y, then z; vectors have 3 consecutive values per
    // cell, scalars 1. Collective.
    virtual void field(scene::FluidField field, std::size_t patch,
                       std::span<float> out) = 0;

    // Throws coupler::Diverged if the solution in a cell is not finite or not physical.
    // Called at the end of every coupled step, on all ranks.
    virtual void check_divergence() = 0;

    // Files of the solver's own beside those of the participant. If it has some, record()
    // is called at the end of every coupled step, with true after the run's last one.
    virtual bool has_own_files() const { return false; }
    virtual void record(bool /*last*/) {}

    // Number of cells, method and other facts of the solver for summary.json.
    virtual output::FluidSummary summary() const = 0;
    // Names and versions of the solver's libraries for summary.json.
    virtual output::Named<std::string> versions() const { return {}; }
    // Time [s] that this rank has spent waiting for neighbouring fluid ranks; it does not
    // count as work in the balance of load.
    virtual double waited_for_neighbours_s() const { return 0; }
    // Number of cells below which a rank has too little work to pay for its messages.
    virtual std::int64_t min_cells_per_rank() const { return 20000; }

    // Saves or restores the solver's part of a checkpoint. Collective; file is null
    // except on rank 0. restore() throws coupler::StateFault if the state does not fit.
    virtual void save(coupler::StateWriter* file) = 0;
    virtual void restore(const coupler::StateReader& file) = 0;
};

}  // namespace magfsi::fluids
