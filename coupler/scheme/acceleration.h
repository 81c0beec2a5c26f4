// SPDX-License-Identifier: GPL-2.0-or-later
// Acceleration methods of the implicit scheme. A step is a fixed point x = H(x): x is a
// guess of the fluid's velocities at the step's end, H(x) the velocities that follow from
// it, its answer. An acceleration makes the next guess from the answers so far. Vectors
// may be spread over the ranks of a communicator; each rank holds its part, in the same
// order throughout.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "coupler/options.h"

namespace magfsi::coupler {

// Inner product of vectors that are spread over ranks, with the same bits on every rank,
// so that all ranks decide alike. Collective; each rank gives its part.
double inner_product(MPI_Comm comm, std::span<const double> a, std::span<const double> b);

// Euclidean norm of a vector that is spread over ranks. Collective.
double norm(MPI_Comm comm, std::span<const double> a);

// A method that finds the fixed point of a step. All calls must be made on all ranks
// alike.
class Acceleration {
  public:
    virtual ~Acceleration() = default;

    // Replaces a guess by the next one, given its answer H(guess).
    virtual void improve(std::span<double> guess, std::span<const double> answer) = 0;

    // Ends a step with the last guess and its answer, whether converged or not. The
    // method keeps what it can reuse in the next step.
    virtual void end_step(std::span<const double> guess,
                          std::span<const double> answer) = 0;

    // State between steps, for checkpoints: numbers() are the same on all ranks,
    // vectors() are this rank's parts. To restore it, make_room() gets the numbers and
    // the size of this rank's part, on a fresh object with the same settings; then
    // vectors() are filled.
    virtual std::vector<double> numbers() const = 0;
    virtual std::vector<std::span<double>> vectors() = 0;
    virtual void make_room(std::span<const double> numbers, std::size_t size) = 0;
};

// The method that the options ask for.
std::unique_ptr<Acceleration> make_acceleration(MPI_Comm comm, const Iteration& wanted);

// Aitken relaxation, x' = x + omega r with r = H(x) - x and a factor that follows from
// the last two residuals (delta-squared method for vectors; Irons and Tuck 1969):
//   omega' = -omega r_old . (r - r_old) / |r - r_old|^2.
class Aitken final : public Acceleration {
  public:
    // first_omega: limit to the magnitude of the first factor of each step, which
    // otherwise is the last one of the step before.
    Aitken(MPI_Comm comm, double first_omega);

    void improve(std::span<double> guess, std::span<const double> answer) override;
    void end_step(std::span<const double>, std::span<const double>) override;
    std::vector<double> numbers() const override { return {omega_}; }
    std::vector<std::span<double>> vectors() override { return {}; }
    void make_room(std::span<const double> numbers, std::size_t size) override;

    double omega() const { return omega_; }

  private:
    MPI_Comm comm_;
    double first_omega_;
    double omega_;
    // Residual of the last iteration of this step; empty at its start.
    std::vector<double> residual_;
    std::vector<double> change_;
};

// Interface quasi-Newton method with the inverse Jacobian from a least-squares model
// (IQN-ILS; Degroote, Bathe, Vierendeels 2009). The model consists of the changes of the
// residual r = H(x) - x and of the answer H(x) between iterations of this step and of
// some steps before,
//   V = changes of r,  W = changes of H(x),
//   x' = H(x) + W c,  c = argmin |V c + r|.
// It is exact after n + 1 iterations if H is linear in n dimensions. The newest columns
// come first; columns that the filter finds dependent are dropped for good.
class IqnIls final : public Acceleration {
  public:
    IqnIls(MPI_Comm comm, const Iteration& wanted);

    void improve(std::span<double> guess, std::span<const double> answer) override;
    void end_step(std::span<const double> guess, std::span<const double> answer) override;
    std::vector<double> numbers() const override;
    std::vector<std::span<double>> vectors() override;
    void make_room(std::span<const double> numbers, std::size_t size) override;

    std::size_t columns() const { return columns_.size(); }
    std::int64_t dropped() const { return dropped_; }  // columns dropped by the filter

  private:
    struct Column {
        std::vector<double> residual, answer;  // changes between two iterations
        int age = 0;                           // steps since they were made
    };

    // Adds the column of a guess and its answer. Returns true if there is any column.
    bool learn(std::span<const double> guess, std::span<const double> answer);
    // Makes the next guess from the model and drops the columns that the filter rejects.
    void build_on_columns(std::span<double> guess, std::span<const double> answer);

    MPI_Comm comm_;
    Iteration wanted_;
    std::deque<Column> columns_;
    bool first_ = true;  // no iteration of this step yet
    std::vector<double> residual_, answer_;
    std::int64_t dropped_ = 0;
};

}  // namespace magfsi::coupler
