// SPDX-License-Identifier: GPL-2.0-or-later
// A step of an implicit scheme is a fixed point x = H(x): H answers to a guess of the
// fluid's velocities at the step's end with those that follow from it. An acceleration
// makes the next guess from what was answered so far. Vectors may be spread over the
// ranks of a communicator, each rank holding its part in the same order throughout.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "coupler/options.h"

namespace magfsi::coupler {

// Inner products of vectors that are spread over ranks. The same bits on every rank, so
// that all decide alike.
// Collective; each rank gives its part.
double inner_product(MPI_Comm comm, std::span<const double> a, std::span<const double> b);

// Euclidean.
double norm(MPI_Comm comm, std::span<const double> a);

class Acceleration {
  public:
    virtual ~Acceleration() = default;

    // The next guess in the place of the last one. Collective.
    virtual void improve(std::span<double> guess, std::span<const double> answer) = 0;

    // The step ends with this pair, converged or not: what was learnt goes on to the next
    // step as far as the method reuses it.
    virtual void end_step(std::span<const double> guess,
                          std::span<const double> answer) = 0;

    // Between steps, for checkpoints: numbers that are the same on all ranks, and vectors
    // (this rank's parts). Given the numbers, a fresh object of the same settings and
    // `size` makes room for the vectors, which are then filled.
    virtual std::vector<double> numbers() const = 0;
    virtual std::vector<std::span<double>> vectors() = 0;
    virtual void make_room(std::span<const double> numbers, std::size_t size) = 0;
};

// The one that the options ask for.
std::unique_ptr<Acceleration> make_acceleration(MPI_Comm comm, const Iteration& wanted);

// x' = x + omega (H(x) - x), omega constant.
class UnderRelaxation final : public Acceleration {
  public:
    explicit UnderRelaxation(double omega) : omega_(omega) {}

    void improve(std::span<double> guess, std::span<const double> answer) override;
    void end_step(std::span<const double>, std::span<const double>) override {}
    std::vector<double> numbers() const override { return {}; }
    std::vector<std::span<double>> vectors() override { return {}; }
    void make_room(std::span<const double>, std::size_t) override {}

  private:
    double omega_;
};

// Relaxation with a factor that follows the last two residuals r = H(x) - x (Aitken's
// delta-squared for vectors; Irons and Tuck 1969):
//   omega' = -omega r_old . (r - r_old) / |r - r_old|^2.
class Aitken final : public Acceleration {
  public:
    // first_omega: of the first iteration of each step, unless the last one's was
    // smaller.
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
    std::vector<double> residual_;  // the last one of this step; empty at its start
    std::vector<double> change_;
};

// Interface quasi-Newton with the inverse of the Jacobian from a least-squares model
// (Degroote, Bathe, Vierendeels 2009): how the residual r = H(x) - x changed with the
// answers H(x) in this step and in some before,
//   V = changes of r,  W = changes of H(x),
//   x' = H(x) + W c,  c = argmin |V c + r|.
// Exact after n + 1 iterations where H is linear in n dimensions. The newest columns come
// first; those that say nothing new are dropped for good.
class IqnIls final : public Acceleration {
  public:
    IqnIls(MPI_Comm comm, const Iteration& wanted);

    void improve(std::span<double> guess, std::span<const double> answer) override;
    void end_step(std::span<const double> guess, std::span<const double> answer) override;
    std::vector<double> numbers() const override;
    std::vector<std::span<double>> vectors() override;
    void make_room(std::span<const double> numbers, std::size_t size) override;

    std::size_t columns() const { return columns_.size(); }
    std::int64_t dropped() const { return dropped_; }  // by the filter so far

  private:
    struct Column {
        std::vector<double> residual, answer;  // changes
        int age = 0;                           // steps ago
    };

    // Takes in a pair; whether there is a column to build on.
    bool learn(std::span<const double> guess, std::span<const double> answer);
    void build_on_columns(std::span<double> guess, std::span<const double> answer);

    MPI_Comm comm_;
    Iteration wanted_;
    std::deque<Column> columns_;
    bool first_ = true;  // of this step
    std::vector<double> residual_, answer_;
    std::int64_t dropped_ = 0;
};

}  // namespace magfsi::coupler
