// Linear fixed points x = A x + b whose solution is known, spread over the ranks; the
// last rank has no part where there are more than two.
#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <Eigen/Dense>
#include <vector>

#include "coupler/scheme/acceleration.h"
#include "tests/mpi/coupler/split.h"

namespace magfsi::coupler::testing {

// The part of a whole vector that this rank holds.
struct Part {
    std::size_t begin = 0, end = 0;
};
inline Part part_of(std::size_t whole) {
    const auto rank = static_cast<std::size_t>(world_rank());
    const auto holders =
        static_cast<std::size_t>(world_size() > 2 ? world_size() - 1 : world_size());
    if (rank >= holders) return {whole, whole};
    return {whole * rank / holders, whole * (rank + 1) / holders};
}
inline std::vector<double> own(const Eigen::VectorXd& whole) {
    const Part part = part_of(static_cast<std::size_t>(whole.size()));
    return {whole.data() + part.begin, whole.data() + part.end};
}
// The whole on every rank.
inline Eigen::VectorXd whole(std::span<const double> mine, Eigen::Index size) {
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
inline LinearMap linear_map(Eigen::Index n, double low, double high) {
    std::srand(7);
    const Eigen::MatrixXd random = Eigen::MatrixXd::Random(n, n);
    const Eigen::MatrixXd q = random.householderQr().householderQ();
    const Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(n, low, high);
    return {q * lambda.asDiagonal() * q.transpose(), Eigen::VectorXd::Random(n)};
}

// Relative distance to the solution of the guesses 0, 1, 2 ... of one step from zero.
inline std::vector<double> errors(Acceleration& acceleration, const LinearMap& map,
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

}  // namespace magfsi::coupler::testing
