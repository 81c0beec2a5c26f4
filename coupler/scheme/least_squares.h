// SPDX-License-Identifier: GPL-2.0-or-later
// The least-squares problem of a quasi-Newton step. Columns are spread over the ranks by
// rows, and some of them may be nearly dependent.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

namespace magfsi::coupler {

// Coefficients of the columns, and the flags of those that the filter kept.
struct LeastSquares {
    std::vector<double> coefficient;  // 0 for dropped columns
    std::vector<bool> kept;
};

// Solves argmin over c of |sum c_i column_i + residual| by a QR decomposition. Each rank
// decomposes its rows and the root the triangles of all ranks (TSQR, Demmel et al. 2012),
// which avoids the loss of digits of normal equations. Columns are examined in their
// order, the most important first, and dropped (filter QR2 of Haelterman et al. 2016) if
// R_ii, the part of column i that is independent of the columns before, is small:
//   |R_ii| < limit |column_i|.
// Collective; the result has the same bits on every rank. Each rank gives its rows of the
// columns and of the residual.
LeastSquares solve_least_squares(MPI_Comm comm,
                                 std::span<const std::span<const double>> columns,
                                 std::span<const double> residual, double limit);

}  // namespace magfsi::coupler
