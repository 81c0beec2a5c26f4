// One level of a refined grid: its place and the fluid that solves its stored cells. Rows
// and boxes here are in global indices of the level.
#pragma once

#include "fluid_lbm/refinement/boxes.h"
#include "fluid_lbm/refinement/patch.h"
#include "fluid_lbm/state.h"

namespace magfsi::fluid {

struct Level {
    Level(MPI_Comm comm, const FluidConfig& coarse, const LevelPlace& where, int level)
        : place(where), fluid(comm, config_at(coarse, where, level)) {}

    LevelPlace place;
    Fluid fluid;

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
