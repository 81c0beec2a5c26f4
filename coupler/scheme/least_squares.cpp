// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/least_squares.h"

#include <Eigen/Dense>
#include <cmath>

namespace magfsi::coupler {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The triangle R of a matrix's QR decomposition, with zero rows where the matrix has too
// few.
Matrix triangle(const Matrix& a) {
    const Eigen::Index n = a.cols();
    Matrix r = Matrix::Zero(n, n);
    const Eigen::Index rows = std::min(n, a.rows());
    if (rows == 0) return r;
    const Eigen::HouseholderQR<Matrix> qr(a);
    r.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
    return r;
}

// On the root: the triangle of the rows of all ranks together. Collective.
Matrix joint_triangle(MPI_Comm comm, const Matrix& mine) {
    int rank = 0, size = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    const Matrix r = triangle(mine);
    if (size == 1) return r;
    Matrix all(rank == 0 ? size * r.rows() : 0, r.cols());
    const int count = r.size();
    MPI_Gather(r.data(), count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE, 0, comm);
    return rank == 0 ? triangle(all) : r;
}

// Some columns of a matrix.
Matrix take(const Matrix& r, const std::vector<Eigen::Index>& columns) {
    Matrix some(r.rows(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i)
        some.col(static_cast<Eigen::Index>(i)) = r.col(columns[i]);
    return some;
}

// Index of the first column that is too dependent on those before, or -1. The rotation
// keeps lengths: columns of the triangle are as long as the columns themselves.
Eigen::Index first_to_drop(const Matrix& r, double limit) {
    for (Eigen::Index i = 0; i < r.cols(); ++i) {
        // Negated, so that a column of zeros is dropped, too.
        if (!(std::abs(r(i, i)) > limit * r.col(i).head(i + 1).norm())) return i;
    }
    return -1;
}

// Drops one column after the other until the filter accepts all, then solves for the
// rest.
void solve_on_root(const Matrix& r, double limit, std::vector<double>& coefficient,
                   std::vector<int>& kept) {
    const Eigen::Index n = r.cols() - 1;  // the last column is the residual
    std::vector<Eigen::Index> columns;
    for (Eigen::Index i = 0; i < n; ++i) columns.push_back(i);
    while (!columns.empty()) {
        std::vector<Eigen::Index> with_residual(columns);
        with_residual.push_back(n);
        const Matrix t = triangle(take(r, with_residual));
        const Eigen::Index m = columns.size();
        const Matrix square = t.topLeftCorner(m, m);
        const Eigen::Index drop = first_to_drop(square, limit);
        if (drop >= 0) {
            columns.erase(columns.begin() + drop);
            continue;
        }
        const Eigen::VectorXd c =
            square.triangularView<Eigen::Upper>().solve(-t.col(m).head(m));
        for (Eigen::Index i = 0; i < m; ++i) {
            const std::size_t column = columns[i];
            coefficient[column] = c(i);
            kept[column] = 1;
        }
        return;
    }
}

}  // namespace

LeastSquares solve_least_squares(MPI_Comm comm,
                                 std::span<const std::span<const double>> columns,
                                 std::span<const double> residual, double limit) {
    const std::size_t n = columns.size();
    Matrix mine(residual.size(), n + 1);
    for (std::size_t row = 0; row < residual.size(); ++row) {
        for (std::size_t i = 0; i < n; ++i)
            mine(Eigen::Index(row), Eigen::Index(i)) = columns[i][row];
        mine(Eigen::Index(row), Eigen::Index(n)) = residual[row];
    }
    const Matrix r = joint_triangle(comm, mine);
    LeastSquares result{std::vector<double>(n), std::vector<bool>(n)};
    std::vector<int> kept(n);
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) solve_on_root(r, limit, result.coefficient, kept);
    MPI_Bcast(result.coefficient.data(), n, MPI_DOUBLE, 0, comm);
    MPI_Bcast(kept.data(), n, MPI_INT, 0, comm);
    for (std::size_t i = 0; i < n; ++i) result.kept[i] = kept[i] != 0;
    return result;
}

}  // namespace magfsi::coupler
