// SPDX-License-Identifier: GPL-2.0-or-later
// What the ranks hold of a checkpoint's tables, to the root and back, independent of how
// many ranks there are.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

namespace magfsi::coupler {

// Rows of `width` numbers, each rank some of them; index: their place among `count` rows
// in all, each held by one rank. All of them on the root, nothing elsewhere. Collective.
std::vector<double> gather_rows(MPI_Comm comm, std::span<const int> index,
                                std::span<const double> rows, std::size_t width,
                                std::size_t count);

// Numbers of which each rank holds a share, as many on every rank: one row a rank on the
// root, nothing elsewhere. Collective.
std::vector<double> gather_shares(MPI_Comm comm, std::span<const double> mine);

// This rank's share of such rows: its own with as many ranks as there were, so that sums
// over the ranks keep their last bit; with another number the root takes all.
std::vector<double> share_of(MPI_Comm comm, std::span<const double> rows,
                             std::size_t ranks_then);

}  // namespace magfsi::coupler
