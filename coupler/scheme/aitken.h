// Relaxation with a factor that follows the last two residuals r = H(x) - x (Aitken's
// delta-squared for vectors; Irons and Tuck 1969):
//   omega' = -omega r_old . (r - r_old) / |r - r_old|^2.
#pragma once

#include "coupler/scheme/acceleration.h"

namespace magfsi::coupler {

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

}  // namespace magfsi::coupler
