// Interface quasi-Newton with the inverse of the Jacobian from a least-squares model
// (Degroote, Bathe, Vierendeels 2009): how the residual r = H(x) - x changed with the
// answers H(x) in this step and in some before,
//   V = changes of r,  W = changes of H(x),
//   x' = H(x) + W c,  c = argmin |V c + r|.
// Exact after n + 1 iterations where H is linear in n dimensions. The newest columns come
// first; those that say nothing new are dropped for good.
#pragma once

#include <deque>

#include "coupler/scheme/acceleration.h"

namespace magfsi::coupler {

class IqnIls final : public Acceleration {
  public:
    IqnIls(MPI_Comm comm, const scene::Iteration& wanted);

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
    scene::Iteration wanted_;
    std::deque<Column> columns_;
    bool first_ = true;  // of this step
    std::vector<double> residual_, answer_;
    std::int64_t dropped_ = 0;
};

}  // namespace magfsi::coupler
