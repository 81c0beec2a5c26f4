// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/acceleration.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupler/scheme/least_squares.h"

namespace magfsi::coupler {

namespace {

void relax(std::span<double> guess, std::span<const double> answer, double omega) {
    for (std::size_t i = 0; i < guess.size(); ++i)
        guess[i] += omega * (answer[i] - guess[i]);
}

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
    std::vector<double> d(a.size());
    std::ranges::transform(a, b, d.begin(), std::minus<>());
    return d;
}

}  // namespace

double inner_product(MPI_Comm comm, std::span<const double> a,
                     std::span<const double> b) {
    const double mine = std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    double all = 0;
    // MPI does not promise the same bits of an all-reduction on every rank.
    MPI_Reduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, 0, comm);
    MPI_Bcast(&all, 1, MPI_DOUBLE, 0, comm);
    return all;
}

double norm(MPI_Comm comm, std::span<const double> a) {
    return std::sqrt(inner_product(comm, a, a));
}

std::unique_ptr<Acceleration> make_acceleration(MPI_Comm comm, const Iteration& wanted) {
    if (wanted.acceleration == AccelerationMethod::aitken)
        return std::make_unique<Aitken>(comm, wanted.relaxation);
    return std::make_unique<IqnIls>(comm, wanted);
}

Aitken::Aitken(MPI_Comm comm, double first_omega)
    : comm_(comm), first_omega_(first_omega), omega_(first_omega) {}

void Aitken::improve(std::span<double> guess, std::span<const double> answer) {
    const std::size_t n = guess.size();
    const bool first = change_.empty();
    // Not empty on a rank without markers, either.
    change_.resize(std::max<std::size_t>(n, 1));
    std::vector<double> residual(n);
    for (std::size_t i = 0; i < n; ++i) residual[i] = answer[i] - guess[i];
    if (first) {
        // The first factor of a step: the last one of the step before with its sign, but
        // no larger than first_omega.
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

IqnIls::IqnIls(MPI_Comm comm, const Iteration& wanted) : comm_(comm), wanted_(wanted) {}

bool IqnIls::learn(std::span<const double> guess, std::span<const double> answer) {
    std::vector<double> residual = difference(answer, guess);
    if (!first_) {
        columns_.push_front(
            {difference(residual, residual_), difference(answer, answer_), 0});
        if (columns_.size() > static_cast<std::size_t>(wanted_.max_used_iterations))
            columns_.pop_back();
    }
    first_ = false;
    residual_ = std::move(residual);
    answer_.assign(answer.begin(), answer.end());
    return !columns_.empty();
}

void IqnIls::improve(std::span<double> guess, std::span<const double> answer) {
    if (learn(guess, answer)) build_on_columns(guess, answer);
    // The guess is relaxed if there is no column: at the start of a run, or if the filter
    // has dropped all.
    if (columns_.empty()) relax(guess, answer, wanted_.relaxation);
}

// The answer replaces the guess only if a column is kept.
void IqnIls::build_on_columns(std::span<double> guess, std::span<const double> answer) {
    std::vector<std::span<const double>> changes;
    for (const Column& column : columns_) changes.emplace_back(column.residual);
    const LeastSquares found =
        solve_least_squares(comm_, changes, residual_, wanted_.filter_limit);
    if (std::ranges::find(found.kept, true) != found.kept.end())
        std::ranges::copy(answer, guess.begin());
    std::deque<Column> kept;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (!found.kept[i]) continue;
        for (std::size_t j = 0; j < guess.size(); ++j)
            guess[j] += found.coefficient[i] * columns_[i].answer[j];
        kept.push_back(std::move(columns_[i]));
    }
    dropped_ += static_cast<std::int64_t>(columns_.size() - kept.size());
    columns_ = std::move(kept);
}

void IqnIls::end_step(std::span<const double> guess, std::span<const double> answer) {
    learn(guess, answer);
    first_ = true;
    for (Column& column : columns_) ++column.age;
    std::erase_if(columns_,
                  [this](const Column& c) { return c.age > wanted_.reused_steps; });
}

std::vector<double> IqnIls::numbers() const {
    std::vector<double> ages;
    for (const Column& column : columns_) ages.push_back(column.age);
    return ages;
}

std::vector<std::span<double>> IqnIls::vectors() {
    std::vector<std::span<double>> all;
    for (Column& column : columns_) {
        all.emplace_back(column.residual);
        all.emplace_back(column.answer);
    }
    return all;
}

void IqnIls::make_room(std::span<const double> ages, std::size_t size) {
    columns_.clear();
    for (const double age : ages)
        columns_.push_back({std::vector<double>(size), std::vector<double>(size),
                            static_cast<int>(age)});
}

}  // namespace magfsi::coupler
