// SPDX-License-Identifier: GPL-2.0-or-later
// How the work of a coupled run is shared between its two sides and over their ranks,
// what the coupling costs, and whether another share would pay.
#pragma once

#include <optional>
#include <string>

#include "coupler/options.h"
#include "coupler/output/summary.h"

namespace magfsi::coupler {

using output::SideLoad;

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
