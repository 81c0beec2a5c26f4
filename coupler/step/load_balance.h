// How the work of a coupled run is shared between its two sides and over their ranks,
// what the coupling costs, and whether another share would pay.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "coupler/options.h"

namespace magfsi::coupler {

// One participant over the whole run. Seconds are means over its ranks, but for two.
struct SideLoad {
    int ranks = 1;
    double working_s = 0;  // all tasks, less waiting
    double waiting_s = 0;  // for the partner
    double solver_s = 0;   // of the work: what the solver would need alone; least rank
    double immersed_boundary_s = 0;  // of the work: markers from and to cells; most rank
    double output_s = 0;             // of the work: probes and files
    double imbalance = 1;            // largest work of a rank over the mean
    double steps_s = 0;  // all tasks: what the steps took as this side saw them
    int most_ranks = 1;  // beyond which a rank has too little to do
};

// Share of the steps' time that goes beyond what solvers, immersed boundary and outputs
// need: in turns (serial), or the slower side (parallel). It is packing, messages and
// waiting for them. The side that started its first step later, after its start-up,
// counts. Clamped at zero.
double coupling_overhead(Scheme scheme, const SideLoad& structure, const SideLoad& fluid);

// Share of the steps' time in which markers take from and give to cells, on the ranks
// that have most of it.
double immersed_boundary_share(const SideLoad& structure, const SideLoad& fluid);

// Ranks and scheme that should be faster by enough to be worth a try, in words with the
// options to give; nothing when there are none. The work of a side is taken to be divided
// by its ranks without loss. cores: of the machine.
std::optional<std::string> advice(Scheme scheme, const SideLoad& structure,
                                  const SideLoad& fluid, double wall_s, int cores);

}  // namespace magfsi::coupler
