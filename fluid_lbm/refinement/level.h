// SPDX-License-Identifier: GPL-2.0-or-later
// One level of a refined grid: its place and the fluid that solves its stored cells. Rows
// and boxes here are in global indices of the level.
#pragma once

#include <memory>

#include "fluid_lbm/refinement/boxes.h"
#include "fluid_lbm/refinement/patch.h"
#include "fluid_lbm/state.h"

namespace magfsi::fluid {

struct Level {
    Level(MPI_Comm comm, const FluidConfig& coarse, const LevelPlace& where, int level)
        : place(where),
          fluid(comm, config_at(coarse, where, level)),
          solids(make_solids(fluid.config())) {}

    LevelPlace place;
    Fluid fluid;
    Solids solids;

    const Fluid::State& state() const { return fluid.state(); }
    MPI_Comm comm() const { return state().comm; }
    // Stored cells of each rank.
    std::vector<CellBox> owned_by_rank() const {
        std::vector<CellBox> boxes;
        for (const CellBox& box : fluid.owned_by_rank())
            boxes.push_back(shifted(box, place.stored.lo));
        return boxes;
    }
    CellBox owned() const { return shifted(state().owned(), place.stored.lo); }

    // Which cells of a box, in this level's indices, lie in obstacles; null without any.
    // Computed from the geometry alone.
    std::unique_ptr<SolidMap> solids_in(const CellBox& box) const {
        const FluidConfig& config = state().config;
        if (config.obstacles.empty() || is_empty(box)) return nullptr;
        std::array<int, 3> back{};
        for (int d = 0; d < 3; ++d) back[d] = -place.stored.lo[d];
        return std::make_unique<SolidMap>(config, solids, shifted(box, back));
    }
    // After populations have been written.
    void reset_solid_cells() { fluid.state().reset_solid_cells(); }

    // Of a row of this rank's cells, in its rank's own indices.
    CellRow local(CellRow row) const {
        const CellBox box = owned();
        row.y -= box.lo[1];
        row.z -= box.lo[2];
        row.x_begin -= box.lo[0];
        row.x_end -= box.lo[0];
        return row;
    }
};

}  // namespace magfsi::fluid
