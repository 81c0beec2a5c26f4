// SPDX-License-Identifier: GPL-2.0-or-later
// The least-squares problem of a quasi-Newton step: columns that are spread over ranks by
// rows, and of which some say almost the same.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "coupler/options.h"

namespace magfsi::coupler {

struct LeastSquares {
    std::vector<double> coefficient;  // of each column; 0 of one that was dropped
    std::vector<bool> kept;
};

// argmin over c of |sum c_i column_i + residual|, by a QR decomposition: each rank
// decomposes its rows, the root the triangles of all (TSQR, Demmel et al. 2012), so no
// digits are lost to normal equations. Columns are looked at in their order, which is
// that of their importance, and dropped (Haelterman et al. 2016) when, with R_ii what
// is new in column i,
//   qr1   |R_ii| < limit |R|,
//   qr2   |R_ii| < limit |column_i|.
// Collective; the same bits on every rank.
LeastSquares solve_least_squares(MPI_Comm comm,
                                 std::span<const std::span<const double>> columns,
                                 std::span<const double> residual, ColumnFilter filter,
                                 double limit);

}  // namespace magfsi::coupler
