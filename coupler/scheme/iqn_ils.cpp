#include "coupler/scheme/iqn_ils.h"

#include <algorithm>

#include "coupler/scheme/least_squares.h"
#include "coupler/scheme/under_relaxation.h"

namespace magfsi::coupler {

namespace {

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
    std::vector<double> d(a.size());
    std::ranges::transform(a, b, d.begin(), std::minus<>());
    return d;
}

}  // namespace

IqnIls::IqnIls(MPI_Comm comm, const scene::Iteration& wanted)
    : comm_(comm), wanted_(wanted) {}

bool IqnIls::learn(std::span<const double> guess, std::span<const double> answer) {
    std::vector<double> residual = difference(answer, guess);
    if (!first_) {
        columns_.push_front(
            {difference(residual, residual_), difference(answer, answer_), 0});
        if (columns_.size() > static_cast<std::size_t>(wanted_.columns))
            columns_.pop_back();
    }
    first_ = false;
    residual_ = std::move(residual);
    answer_.assign(answer.begin(), answer.end());
    return !columns_.empty();
}

void IqnIls::improve(std::span<double> guess, std::span<const double> answer) {
    if (learn(guess, answer)) build_on_columns(guess, answer);
    // The filter may have left none.
    if (columns_.empty()) relax(guess, answer, wanted_.relaxation);
}

void IqnIls::build_on_columns(std::span<double> guess, std::span<const double> answer) {
    std::vector<std::span<const double>> changes;
    for (const Column& column : columns_) changes.emplace_back(column.residual);
    const LeastSquares found = solve_least_squares(comm_, changes, residual_,
                                                   wanted_.filter, wanted_.filter_limit);
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
