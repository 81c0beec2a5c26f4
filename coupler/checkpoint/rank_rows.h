// SPDX-License-Identifier: GPL-2.0-or-later
// Tables of a checkpoint whose rows are spread over the ranks: gathering them on the root
// and giving them back, independent of the number of ranks.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

namespace magfsi::coupler {

// Gathers a table of `count` rows of `width` numbers each. rows: this rank's rows, row
// after row; index: the place of each of them in the table. Every place must be held by
// exactly one rank. Returns the table on rank 0, an empty vector elsewhere. Collective.
std::vector<double> gather_rows(MPI_Comm comm, std::span<const int> index,
                                std::span<const double> rows, std::size_t width,
                                std::size_t count);

// Gathers numbers of which every rank holds equally many: the result has one row per rank
// on rank 0 and is empty elsewhere. Collective.
std::vector<double> gather_shares(MPI_Comm comm, std::span<const double> mine);

// This rank's share of a table that gather_shares made on `ranks_then` ranks. With as
// many ranks as then it is the rank's own row, so that sums over the ranks keep their
// last bit; with another number rank 0 takes the sum of all rows and the others zeros.
std::vector<double> share_of(MPI_Comm comm, std::span<const double> rows,
                             std::size_t ranks_then);

}  // namespace magfsi::coupler
