// SPDX-License-Identifier: GPL-2.0-or-later
// Balance of the work of a coupled run between its two sides and over their ranks, the
// cost of the coupling, and advice on a better division.
#pragma once

#include <optional>
#include <string>

#include "coupler/output/summary.h"

namespace magfsi::coupler {

using output::SideLoad;

// Share of the steps' time beyond what solvers, immersed boundary and outputs need:
// packing, messages and waiting for them. The need is the sum of both sides, which take
// turns. The steps' time is that of the side that started its first step later. At least
// 0.
double coupling_overhead(const SideLoad& structure, const SideLoad& fluid);

// Share of the steps' time for moving data between markers and cells, on the ranks that
// have most of it.
double immersed_boundary_share(const SideLoad& structure, const SideLoad& fluid);

// Numbers of ranks that should be faster by enough to be worth a try, in words with the
// option to give; nothing if there are none. The work of a side is assumed to be divided
// by its ranks without loss. cores: number of cores of the machine.
std::optional<std::string> advice(const SideLoad& structure, const SideLoad& fluid,
                                  double wall_s, int cores);

}  // namespace magfsi::coupler
