// SPDX-License-Identifier: GPL-2.0-or-later
// One level of a refined grid: its place and the fluid that solves its stored cells. Rows
// and boxes here are in global indices of the level.
#pragma once

#include <memory>

#include "fluid_lbm/refinement/boxes.h"
#include "fluid_lbm/refinement/patch.h"
#include "fluid_lbm/state.h"

namespace magfsi::fluid {

// A patch, or level 0. Construction is collective and throws as Fluid does.
struct Level {
    Level(MPI_Comm comm, const FluidConfig& coarse, const LevelPlace& where, int level)
        : place(where),
          fluid(comm, config_at(coarse, where, level)),
          solids(make_solids(fluid.config())),
          owned_(shifted(state().owned(), place.stored.lo)) {}

    LevelPlace place;
    Fluid fluid;
    Solids solids;

    const Fluid::State& state() const { return fluid.state(); }
    MPI_Comm comm() const { return state().comm; }
    // The stored cells of each rank, and those of this rank.
    std::vector<CellBox> owned_by_rank() const {
        std::vector<CellBox> boxes;
        for (const CellBox& box : fluid.owned_by_rank())
            boxes.push_back(shifted(box, place.stored.lo));
        return boxes;
    }
    const CellBox& owned() const { return owned_; }

    // Map of the solid cells of a box in this level's indices; null in a scene without
    // obstacles. It is computed from the geometry alone, without messages.
    std::unique_ptr<SolidMap> solids_in(const CellBox& box) const {
        const FluidConfig& config = state().config;
        if (config.obstacles.empty() || is_empty(box)) return nullptr;
        std::array<int, 3> back{};
        for (int d = 0; d < 3; ++d) back[d] = -place.stored.lo[d];
        return std::make_unique<SolidMap>(config, solids, shifted(box, back));
    }
    // Sets solid cells back to rest; must follow every change of populations.
    void reset_solid_cells() { fluid.state().reset_solid_cells(); }

    // A row of this rank's cells in the rank's local indices.
    CellRow local(CellRow row) const {
        row.y -= owned_.lo[1];
        row.z -= owned_.lo[2];
        row.x_begin -= owned_.lo[0];
        row.x_end -= owned_.lo[0];
        return row;
    }

  private:
    CellBox owned_;
};

}  // namespace magfsi::fluid
