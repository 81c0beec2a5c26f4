// SPDX-License-Identifier: GPL-2.0-or-later
// The accelerations on linear maps.
#include "coupler/scheme/acceleration.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "coupler/scheme/least_squares.h"
#include "tests/mpi/coupler/split.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Linear fixed points x = A x + b whose solution is known, spread over the ranks; the
// last rank has no part where there are more than two.
// The part of a whole vector that this rank holds.
struct Part {
    std::size_t begin = 0, end = 0;
};
Part part_of(std::size_t whole) {
    const auto rank = static_cast<std::size_t>(world_rank());
    const auto holders =
        static_cast<std::size_t>(world_size() > 2 ? world_size() - 1 : world_size());
    if (rank >= holders) return {whole, whole};
    return {whole * rank / holders, whole * (rank + 1) / holders};
}
std::vector<double> own(const Eigen::VectorXd& whole) {
    const Part part = part_of(static_cast<std::size_t>(whole.size()));
    return {whole.data() + part.begin, whole.data() + part.end};
}
// The whole on every rank.
Eigen::VectorXd whole(std::span<const double> mine, Eigen::Index size) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
    const Part part = part_of(static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < mine.size(); ++i)
        all(static_cast<Eigen::Index>(part.begin + i)) = mine[i];
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(size), MPI_DOUBLE, MPI_SUM,
                  MPI_COMM_WORLD);
    return all;
}

struct LinearMap {
    Eigen::MatrixXd a;
    Eigen::VectorXd b;

    Eigen::VectorXd operator()(const Eigen::VectorXd& x) const { return a * x + b; }
    Eigen::VectorXd solution() const {
        return (Eigen::MatrixXd::Identity(a.rows(), a.cols()) - a)
            .partialPivLu()
            .solve(b);
    }
};

// Eigenvalues spread evenly from low to high, eigenvectors of no particular direction.
LinearMap linear_map(Eigen::Index n, double low, double high) {
    std::srand(7);
    const Eigen::MatrixXd random = Eigen::MatrixXd::Random(n, n);
    const Eigen::MatrixXd q = random.householderQr().householderQ();
    const Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(n, low, high);
    return {q * lambda.asDiagonal() * q.transpose(), Eigen::VectorXd::Random(n)};
}

// Relative distance to the solution of the guesses 0, 1, 2 ... of one step from zero.
std::vector<double> errors(Acceleration& acceleration, const LinearMap& map,
                           int iterations) {
    const Eigen::VectorXd solution = map.solution();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(solution.size());
    std::vector<double> found{1.0};
    std::vector<double> guess = own(x);
    for (int i = 0; i < iterations; ++i) {
        acceleration.improve(guess, own(map(x)));
        x = whole(guess, x.size());
        found.push_back((x - solution).norm() / solution.norm());
    }
    acceleration.end_step(guess, own(map(x)));
    return found;
}

// The same distance after iterations with a constant factor.
double error_of_constant(double omega, const LinearMap& map, int iterations) {
    const Eigen::VectorXd solution = map.solution();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(solution.size());
    for (int i = 0; i < iterations; ++i) x += omega * (map(x) - x);
    return (x - solution).norm() / solution.norm();
}

TEST(Aitken, one_dimension_is_exact_after_two_iterations) {
    Aitken aitken(MPI_COMM_WORLD, 0.3);
    const LinearMap map = linear_map(1, -4, -4);
    const auto error = errors(aitken, map, 2);
    EXPECT_GT(error[1], 0.1);
    EXPECT_LT(error[2], 1e-14);
    // The factor of Newton's method: 1 / (1 - a).
    EXPECT_NEAR(aitken.omega(), 1.0 / 5, 1e-14);
}

TEST(Aitken, beats_the_constant_factor_that_it_begins_with) {
    const LinearMap map = linear_map(8, -0.5, 0.6);
    for (const double omega : {0.2, 0.5, 0.9}) {
        Aitken aitken(MPI_COMM_WORLD, omega);
        EXPECT_LT(errors(aitken, map, 12).back(), error_of_constant(omega, map, 12))
            << omega;
    }
}

TEST(Aitken, converges_where_the_constant_factor_does_not) {
    const LinearMap map = linear_map(4, -5, -4);
    EXPECT_GT(error_of_constant(0.5, map, 12), 100);
    Aitken aitken(MPI_COMM_WORLD, 0.5);
    EXPECT_LT(errors(aitken, map, 12).back(), 1e-6);  // gains a digit an iteration
}

TEST(Aitken, a_step_begins_no_bolder_than_the_user_says) {
    Aitken aitken(MPI_COMM_WORLD, 0.3);
    errors(aitken, linear_map(1, 0.9, 0.9), 2);  // the factor becomes 10
    EXPECT_NEAR(aitken.omega(), 10, 1e-10);
    const auto error = errors(aitken, linear_map(1, 0.9, 0.9), 1);
    EXPECT_NEAR(error[1], 1 - 0.3 * 0.1, 1e-12);
}

// One step after a restart is that of an acceleration which was never interrupted.
TEST(Accelerations, go_on_from_a_checkpoint_as_if_nothing_had_been) {
    const LinearMap map = linear_map(6, -3, 0.7);
    for (const auto method : {AccelerationMethod::aitken, AccelerationMethod::iqn_ils}) {
        Iteration wanted;
        wanted.acceleration = method;
        wanted.reused_steps = 2;
        wanted.relaxation = 1;  // more than the factors that Aitken finds
        const auto whole_run = make_acceleration(MPI_COMM_WORLD, wanted);
        errors(*whole_run, map, 5);
        const auto resumed = make_acceleration(MPI_COMM_WORLD, wanted);
        resumed->make_room(whole_run->numbers(), own(map.b).size());
        const auto from = whole_run->vectors(), to = resumed->vectors();
        ASSERT_EQ(from.size(), to.size());
        for (std::size_t i = 0; i < to.size(); ++i)
            std::ranges::copy(from[i], to[i].begin());
        EXPECT_EQ(errors(*resumed, map, 3), errors(*whole_run, map, 3));
    }
}

// The quasi-Newton acceleration on linear maps, where it must be exact after as many
// iterations as there are dimensions, whatever the map does by itself.
// Least squares of some 1e-16, magnified by the map's condition of up to 1e3.
constexpr double exact = 1e-10;

coupler::Iteration settings(int reused_steps = 0) {
    coupler::Iteration wanted;
    wanted.reused_steps = reused_steps;
    wanted.filter_limit = 1e-12;
    return wanted;
}

TEST(IqnIls, solves_n_dimensions_in_n_plus_one_iterations) {
    for (const int n : {1, 2, 5, 9}) {
        IqnIls iqn(MPI_COMM_WORLD, settings());
        const auto error = errors(iqn, linear_map(n, -0.5, 0.8), n + 1);
        EXPECT_LT(error.back(), exact) << n;
        if (n == 1) continue;
        EXPECT_GT(error[static_cast<std::size_t>(n)], exact) << n;
    }
}

TEST(IqnIls, converges_where_the_map_itself_diverges) {
    constexpr int n = 6;
    // Relaxed by a half, the worst direction grows by |1 - 0.5 * (1 + 9)| = 4 a step.
    const LinearMap map = linear_map(n, -9, -2);
    EXPECT_GT(error_of_constant(0.5, map, n + 1), 100);
    IqnIls iqn(MPI_COMM_WORLD, settings());
    EXPECT_LT(errors(iqn, map, n + 1).back(), exact);
}

TEST(IqnIls, what_a_step_taught_serves_the_next) {
    constexpr int n = 6;
    LinearMap map = linear_map(n, -3, 0.7);
    IqnIls iqn(MPI_COMM_WORLD, settings(1));
    errors(iqn, map, n + 1);
    map.b *= -2;  // another step: the same Jacobian
    EXPECT_LT(errors(iqn, map, 1).back(), exact);
    // One that forgets has to start again.
    IqnIls forgetful(MPI_COMM_WORLD, settings(0));
    errors(forgetful, map, n + 1);
    EXPECT_EQ(forgetful.columns(), 0u);
    EXPECT_GT(errors(forgetful, map, 1).back(), exact);
}

TEST(IqnIls, keeps_as_many_columns_and_steps_as_it_may) {
    coupler::Iteration wanted = settings(2);
    wanted.max_used_iterations = 7;
    IqnIls iqn(MPI_COMM_WORLD, wanted);
    const LinearMap map = linear_map(40, -0.9, 0.9);
    errors(iqn, map, 3);
    EXPECT_EQ(iqn.columns(), 3u);
    errors(iqn, map, 3);
    EXPECT_EQ(iqn.columns(), 6u);
    errors(iqn, map, 5);
    EXPECT_EQ(iqn.columns(), 7u);
}

TEST(IqnIls, drops_what_says_nothing_new) {
    // Three dimensions cannot give more than three columns that differ.
    coupler::Iteration wanted = settings(5);
    wanted.filter_limit = 1e-3;
    IqnIls iqn(MPI_COMM_WORLD, wanted);
    LinearMap map = linear_map(3, -3, 0.7);
    for (int step = 0; step < 5; ++step) {
        map.b = Eigen::VectorXd::Random(3);
        errors(iqn, map, 3);
    }
    EXPECT_GT(iqn.dropped(), 0);
    EXPECT_LE(iqn.columns(), 4u);  // the last pair of a step is looked at in the next
    map.b = Eigen::VectorXd::Random(3);
    EXPECT_LT(errors(iqn, map, 2).back(), exact);
}

// Between steps its state is that of its numbers and vectors.
TEST(IqnIls, goes_on_from_what_a_checkpoint_keeps) {
    constexpr int n = 6;
    const LinearMap map = linear_map(n, -3, 0.7);
    IqnIls first(MPI_COMM_WORLD, settings(3)), second(MPI_COMM_WORLD, settings(3));
    errors(first, map, 3);
    second.make_room(first.numbers(), own(map.b).size());
    const auto from = first.vectors();
    const auto to = second.vectors();
    ASSERT_EQ(from.size(), to.size());
    for (std::size_t i = 0; i < to.size(); ++i)
        std::copy(from[i].begin(), from[i].end(), to[i].begin());
    EXPECT_EQ(errors(first, map, 3), errors(second, map, 3));
}

// Nothing moves: every pair is zero.
TEST(IqnIls, at_rest_stays_at_rest) {
    IqnIls iqn(MPI_COMM_WORLD, settings(2));
    std::vector<double> guess = own(Eigen::VectorXd::Zero(5));
    for (int i = 0; i < 4; ++i) iqn.improve(guess, own(Eigen::VectorXd::Zero(5)));
    for (const double value : guess) EXPECT_EQ(value, 0);
}

// The distributed least squares against Eigen's on one rank, and what the filter drops.
LeastSquares solve(const Eigen::MatrixXd& v, const Eigen::VectorXd& r, double limit) {
    std::vector<std::vector<double>> columns;
    for (Eigen::Index i = 0; i < v.cols(); ++i) columns.push_back(own(v.col(i)));
    const std::vector<std::span<const double>> views(columns.begin(), columns.end());
    return solve_least_squares(MPI_COMM_WORLD, views, own(r), limit);
}

TEST(LeastSquares, agrees_with_a_decomposition_on_one_rank) {
    std::srand(3);
    const Eigen::MatrixXd v = Eigen::MatrixXd::Random(37, 6);
    const Eigen::VectorXd r = Eigen::VectorXd::Random(37);
    const Eigen::VectorXd expected = v.colPivHouseholderQr().solve(-r);
    const auto found = solve(v, r, 1e-10);
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
    const auto found = solve(v, -v * wanted, 1e-12);
    EXPECT_NEAR(found.coefficient[0], 2, 1e-8);  // 1e7 times 1e-16, and some
    EXPECT_NEAR(found.coefficient[1], -3, 1e-8);
}

TEST(LeastSquares, drops_the_later_of_two_that_depend_on_each_other) {
    std::srand(5);
    Eigen::MatrixXd v = Eigen::MatrixXd::Random(25, 4);
    v.col(2) = 3 * v.col(0) - v.col(1);
    const Eigen::VectorXd r = v.col(0) + v.col(3);
    const auto found = solve(v, r, 1e-6);
    EXPECT_EQ(found.kept, (std::vector<bool>{true, true, false, true}));
    EXPECT_EQ(found.coefficient[2], 0);
    EXPECT_NEAR(found.coefficient[0], -1, 1e-12);
    EXPECT_NEAR(found.coefficient[3], -1, 1e-12);
}

TEST(LeastSquares, keeps_a_small_column_of_its_own_direction) {
    std::srand(6);
    Eigen::MatrixXd v = Eigen::MatrixXd::Random(15, 2);
    v.col(1) *= 1e-5;
    const Eigen::VectorXd r = -v.col(1);
    const auto found = solve(v, r, 1e-3);
    EXPECT_TRUE(found.kept[1]);
    EXPECT_NEAR(found.coefficient[1], 1, 1e-10);
}

TEST(LeastSquares, columns_of_zeros_go) {
    const Eigen::MatrixXd v = Eigen::MatrixXd::Zero(9, 2);
    const auto found = solve(v, Eigen::VectorXd::Ones(9), 1e-3);
    EXPECT_EQ(found.kept, (std::vector<bool>{false, false}));
    EXPECT_EQ(found.coefficient, (std::vector<double>{0, 0}));
}

TEST(LeastSquares, fewer_rows_than_columns) {
    std::srand(8);
    const Eigen::MatrixXd v = Eigen::MatrixXd::Random(2, 4);
    const Eigen::VectorXd r = Eigen::VectorXd::Random(2);
    const auto found = solve(v, r, 1e-6);
    EXPECT_EQ(found.kept, (std::vector<bool>{true, true, false, false}));
    const Eigen::Vector2d c(found.coefficient[0], found.coefficient[1]);
    EXPECT_LT((v.leftCols(2) * c + r).norm(), 1e-13);
}

}  // namespace
}  // namespace magfsi::coupler
