#include "coupler/scheme/aitken.h"

#include <algorithm>
#include <cmath>

#include "coupler/scheme/inner_product.h"
#include "coupler/scheme/under_relaxation.h"

namespace magfsi::coupler {

Aitken::Aitken(MPI_Comm comm, double first_omega)
    : comm_(comm), first_omega_(first_omega), omega_(first_omega) {}

void Aitken::improve(std::span<double> guess, std::span<const double> answer) {
    const std::size_t n = guess.size();
    const bool first = change_.empty();
    change_.resize(std::max<std::size_t>(n, 1));  // a rank may have no part
    std::vector<double> residual(n);
    for (std::size_t i = 0; i < n; ++i) residual[i] = answer[i] - guess[i];
    if (first) {
        // As a step begins: no larger than the user's, of the sign that was found.
        omega_ = std::copysign(std::min(std::abs(omega_), first_omega_), omega_);
    } else {
        const std::span<double> change(change_.data(), n);
        for (std::size_t i = 0; i < n; ++i) change[i] = residual[i] - residual_[i];
        const double length2 = inner_product(comm_, change, change);
        if (length2 > 0) omega_ *= -inner_product(comm_, residual_, change) / length2;
    }
    relax(guess, answer, omega_);
    residual_ = std::move(residual);
}

void Aitken::end_step(std::span<const double>, std::span<const double>) {
    residual_.clear();
    change_.clear();
}

void Aitken::make_room(std::span<const double> numbers, std::size_t) {
    omega_ = numbers[0];
}

}  // namespace magfsi::coupler
