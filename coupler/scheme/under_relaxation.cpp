#include "coupler/scheme/under_relaxation.h"

namespace magfsi::coupler {

void relax(std::span<double> guess, std::span<const double> answer, double omega) {
    for (std::size_t i = 0; i < guess.size(); ++i)
        guess[i] += omega * (answer[i] - guess[i]);
}

void UnderRelaxation::improve(std::span<double> guess, std::span<const double> answer) {
    relax(guess, answer, omega_);
}

}  // namespace magfsi::coupler
