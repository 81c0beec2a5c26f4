// SPDX-License-Identifier: GPL-2.0-or-later
// The levels of a refined grid and the transfers between them, for the files that
// implement RefinedFluid.
#pragma once

#include <memory>
#include <optional>

#include "fluid_lbm/refinement/interface_flux.h"
#include "fluid_lbm/refinement/prolongation.h"
#include "fluid_lbm/refinement/refined_fluid.h"
#include "fluid_lbm/refinement/restriction.h"

namespace magfsi::fluid {

// Sum of a value over all ranks. Collective.
inline double summed(MPI_Comm comm, double value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm);
    return value;
}

// Balance of mass at the interface between two levels, in cells of the coarser level at
// rest: the mass that has entered the covered box according to the coarser level, minus
// the mass that the finer one has received. It is given to the coarse cells beside the
// patch, the same to each. Refluxing (Berger, Colella 1989) does this face by face.
struct InterfaceMass {
    double lost = 0;   // this rank's part, in the coarser level's present step
    double owed = 0;   // mass of all ranks that is to be given besides
    double given = 0;  // mass given after the coarser level's last step
    // Values of lost and owed before the finest level's last step.
    double lost_then = 0, owed_then = 0;
    // Number of the coarse cells beside the patch, over all ranks.
    std::int64_t beside = 0;
};

// A patch of one level and the transfers between it and the level below.
struct FinerLevel {
    FinerLevel(MPI_Comm comm, const FluidConfig& coarsest, const Level& below,
               const LevelPlace& place, int number)
        : level(comm, coarsest, place, number),
          ring(below, place, ring_of(level)),
          band(below, level, band_of(place)),
          from_below(below, place.covered(), place),
          into_level(level, place.inside, place) {}

    // The transfer of all covered cells to the level below, made at its first use.
    Restriction& all_covered(const Level& below) {
        if (!whole) whole.emplace(below, level, std::vector{level.place.covered()});
        return *whole;
    }

    Level level;
    Prolongation ring;  // fills the ring from the level below
    Restriction band;   // overwrites the covered cells that the level below reads
    // Overwrites all covered cells; made when it is needed.
    std::optional<Restriction> whole;
    // Mass through the interface as either level sees it.
    InterfaceFlux from_below, into_level;
    InterfaceMass mass;
};

// Level 0 and the nests of finer patches.
struct RefinedFluid::Levels {
    Levels(MPI_Comm comm, const FluidConfig& coarse)
        : coarsest(comm, coarse, coarsest_place(coarse.cells, periodic_axes(coarse)), 0) {
    }

    Level coarsest;
    std::vector<Nest> nests;

    // The level of a number in a nest; level 0 is common to all nests.
    Level& at(int number, int nest) {
        return number == 0 ? coarsest : above(number - 1, nest).level;
    }
    // The patch above level `number`, that is of level number + 1, in a nest.
    FinerLevel& above(int number, int nest) { return *nests[nest][number]; }
};

}  // namespace magfsi::fluid
