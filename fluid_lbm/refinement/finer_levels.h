// SPDX-License-Identifier: GPL-2.0-or-later
// The levels of a refined grid and what stands between them: for the files that implement
// RefinedFluid.
#pragma once

#include <memory>
#include <optional>

#include "fluid_lbm/refinement/interface_flux.h"
#include "fluid_lbm/refinement/prolongation.h"
#include "fluid_lbm/refinement/refined_fluid.h"
#include "fluid_lbm/refinement/restriction.h"

namespace magfsi::fluid {

// Over all ranks.
inline double summed(MPI_Comm comm, double value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm);
    return value;
}

// Of an interface between two levels, in cells of the coarser at rest: mass that has gone
// into the covered box as the coarser level sees it, less what the finer one has
// received. It goes to the coarse cells beside the patch: what refluxing (Berger, Colella
// 1989) does face by face, in the mean over them.
struct InterfaceMass {
    double lost = 0;   // of this rank, in the coarser level's present step
    double owed = 0;   // besides, of all ranks
    double given = 0;  // by the last step of the coarser level
    double lost_then = 0, owed_then = 0;  // before the last step of the finest level
    std::int64_t beside = 0;              // cells
};

// A level and the two ways between it and the one below.
struct FinerLevel {
    FinerLevel(MPI_Comm comm, const FluidConfig& coarsest, const Level& below,
               const LevelPlace& place, int number)
        : level(comm, coarsest, place, number),
          ring(below, place, ring_of(level)),
          band(below, level, band_of(place)),
          from_below(below, place.covered(), place),
          into_level(level, place.inside, place) {}

    Restriction& all_covered(const Level& below) {
        if (!whole) whole.emplace(below, level, std::vector{level.place.covered()});
        return *whole;
    }

    Level level;
    Prolongation ring;
    Restriction band;
    std::optional<Restriction> whole;  // of all covered cells, once it is wanted
    InterfaceFlux from_below, into_level;
    InterfaceMass mass;
};

struct RefinedFluid::Levels {
    Levels(MPI_Comm comm, const FluidConfig& coarse)
        : coarsest(comm, coarse, coarsest_place(coarse.cells, periodic_axes(coarse)), 0) {
    }

    Level coarsest;
    std::vector<Nest> nests;

    // Level 0 is the same in all nests.
    Level& at(int number, int nest) {
        return number == 0 ? coarsest : above(number - 1, nest).level;
    }
    FinerLevel& above(int number, int nest) {
        return *nests[static_cast<std::size_t>(nest)][static_cast<std::size_t>(number)];
    }
};

}  // namespace magfsi::fluid
