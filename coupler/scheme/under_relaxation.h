// x' = x + omega (H(x) - x), omega constant.
#pragma once

#include "coupler/scheme/acceleration.h"

namespace magfsi::coupler {

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

// The step itself, for those that begin with it.
void relax(std::span<double> guess, std::span<const double> answer, double omega);

}  // namespace magfsi::coupler
