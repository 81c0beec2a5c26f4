// The distributed least squares against Eigen's on one rank, and what the filters drop.
#include "coupler/scheme/least_squares.h"

#include "tests/mpi/coupler/fixed_points.h"

namespace magfsi::coupler {
namespace {

using namespace testing;
using coupler::ColumnFilter;

LeastSquares solve(const Eigen::MatrixXd& v, const Eigen::VectorXd& r,
                   ColumnFilter filter, double limit) {
    std::vector<std::vector<double>> columns;
    for (Eigen::Index i = 0; i < v.cols(); ++i) columns.push_back(own(v.col(i)));
    const std::vector<std::span<const double>> views(columns.begin(), columns.end());
    return solve_least_squares(MPI_COMM_WORLD, views, own(r), filter, limit);
}

TEST(LeastSquares, agrees_with_a_decomposition_on_one_rank) {
    std::srand(3);
    const Eigen::MatrixXd v = Eigen::MatrixXd::Random(37, 6);
    const Eigen::VectorXd r = Eigen::VectorXd::Random(37);
    const Eigen::VectorXd expected = v.colPivHouseholderQr().solve(-r);
    const auto found = solve(v, r, ColumnFilter::qr2, 1e-10);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_TRUE(found.kept[i]);
        // Some 40 roundings of numbers of order one.
        EXPECT_NEAR(found.coefficient[i], expected(static_cast<Eigen::Index>(i)), 1e-14);
    }
}

// Normal equations would square the condition of 1e7 and lose all but two digits.
TEST(LeastSquares, loses_no_digits_to_normal_equations) {
    std::srand(4);
    Eigen::MatrixXd v = Eigen::MatrixXd::Random(20, 2);
    v.col(1) = v.col(0) + 1e-7 * v.col(1);
    const Eigen::Vector2d wanted(2, -3);
    const auto found = solve(v, -v * wanted, ColumnFilter::qr2, 1e-12);
    EXPECT_NEAR(found.coefficient[0], 2, 1e-8);  // 1e7 times 1e-16, and some
    EXPECT_NEAR(found.coefficient[1], -3, 1e-8);
}

TEST(LeastSquares, drops_the_later_of_two_that_depend_on_each_other) {
    std::srand(5);
    Eigen::MatrixXd v = Eigen::MatrixXd::Random(25, 4);
    v.col(2) = 3 * v.col(0) - v.col(1);
    const Eigen::VectorXd r = v.col(0) + v.col(3);
    for (const auto filter : {ColumnFilter::qr1, ColumnFilter::qr2}) {
        const auto found = solve(v, r, filter, 1e-6);
        EXPECT_EQ(found.kept, (std::vector<bool>{true, true, false, true}));
        EXPECT_EQ(found.coefficient[2], 0);
        EXPECT_NEAR(found.coefficient[0], -1, 1e-12);
        EXPECT_NEAR(found.coefficient[3], -1, 1e-12);
    }
}

// qr1 measures by all columns and drops a small one; qr2 by itself and keeps it.
TEST(LeastSquares, a_small_column_of_its_own_direction) {
    std::srand(6);
    Eigen::MatrixXd v = Eigen::MatrixXd::Random(15, 2);
    v.col(1) *= 1e-5;
    const Eigen::VectorXd r = -v.col(1);
    EXPECT_FALSE(solve(v, r, ColumnFilter::qr1, 1e-3).kept[1]);
    const auto kept = solve(v, r, ColumnFilter::qr2, 1e-3);
    EXPECT_TRUE(kept.kept[1]);
    EXPECT_NEAR(kept.coefficient[1], 1, 1e-10);
}

TEST(LeastSquares, columns_of_zeros_go) {
    const Eigen::MatrixXd v = Eigen::MatrixXd::Zero(9, 2);
    const auto found = solve(v, Eigen::VectorXd::Ones(9), ColumnFilter::qr2, 1e-3);
    EXPECT_EQ(found.kept, (std::vector<bool>{false, false}));
    EXPECT_EQ(found.coefficient, (std::vector<double>{0, 0}));
}

TEST(LeastSquares, fewer_rows_than_columns) {
    std::srand(8);
    const Eigen::MatrixXd v = Eigen::MatrixXd::Random(2, 4);
    const Eigen::VectorXd r = Eigen::VectorXd::Random(2);
    const auto found = solve(v, r, ColumnFilter::qr2, 1e-6);
    EXPECT_EQ(found.kept, (std::vector<bool>{true, true, false, false}));
    const Eigen::Vector2d c(found.coefficient[0], found.coefficient[1]);
    EXPECT_LT((v.leftCols(2) * c + r).norm(), 1e-13);
}

}  // namespace
}  // namespace magfsi::coupler
