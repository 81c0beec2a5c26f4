// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/fixed_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "coupler/participants/errors.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

namespace {

// Tag of the convergence message.
constexpr int convergence_tag = 75;

// Norm of a vector with `size` at each marker of all ranks. Collective.
double norm_of_all(MPI_Comm comm, double size, std::size_t markers) {
    double count = markers;
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, comm);
    return size * std::sqrt(count);
}

}  // namespace

ConvergenceSender::ConvergenceSender(const World& world, double timeout_s)
    : world_(world), timeout_s_(timeout_s) {}

ConvergenceSender::~ConvergenceSender() {
    if (std::uncaught_exceptions() > 0) return;
    try {
        wait_all({&sending_, 1}, timeout_s_, "receiver of the last convergence message");
    } catch (const std::exception&) {
        // The fluid waits no more for this message and has reported why.
    }
}

void ConvergenceSender::send(const Occasion& when, bool again) {
    if (!world_.root()) return;
    wait_all({&sending_, 1}, timeout_s_, "receiver of the convergence message");
    note_ = {when.step, when.iteration, again ? 1 : 0};
    world_.send(note_.data(), 3, MPI_INT64_T, 0, convergence_tag, &sending_);
}

bool step_is_repeated(const World& world, const Occasion& when, double timeout_s) {
    std::array<std::int64_t, 3> note{};
    if (world.root()) {
        world.receive_from_root(note.data(), 3, MPI_INT64_T, convergence_tag, timeout_s,
                                fmt::format("convergence of iteration {} of step {}",
                                            when.iteration, when.step));
    }
    MPI_Bcast(note.data(), 3, MPI_INT64_T, 0, world.local());
    if (note[0] == when.step && note[1] == when.iteration) return note[2] != 0;
    throw PartnerLost(fmt::format(
        "the two sides are out of step: convergence of step {}, iteration {}, expected "
        "step {}, iteration {}; start both with the same scene, from the same build",
        note[0], note[1], when.step, when.iteration));
}

FixedPoint::FixedPoint(const World& world, const Setting& setting, std::size_t markers)
    : world_(world),
      setting_(setting),
      rest_norm_m_s_(norm_of_all(world.local(), setting.rest_m_s, markers)),
      acceleration_(make_acceleration(world.local(), setting.iteration)),
      convergence_(world, setting.timeout_s),
      guess_(markers) {
    record_.measure = "fluid velocity at the markers";
    record_.acceleration = name_of(setting.iteration.acceleration);
    record_.tolerance = setting.iteration.velocity_tolerance;
}

void FixedPoint::begin_step(std::span<const Vec3> now, std::span<const Vec3> before) {
    iteration_ = 0;
    std::ranges::copy(now, guess_.begin());
    if (setting_.iteration.initial_guess == InitialGuess::constant) return;
    for (std::size_t m = 0; m < guess_.size(); ++m) guess_[m] += now[m] - before[m];
}

double FixedPoint::measure(std::span<const double> answer) const {
    const auto guess = flat(guess_);
    std::vector<double> residual(answer.begin(), answer.end());
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= guess[i];
    return norm(world_.local(), residual) /
           std::max(norm(world_.local(), answer), rest_norm_m_s_);
}

void FixedPoint::count(double residual, bool converged) {
    ++record_.steps;
    record_.iterations += iteration_ + 1;
    record_.most = std::max(record_.most, iteration_ + 1);
    record_.residual_sum += residual;
    record_.worst_residual = std::max(record_.worst_residual, residual);
    if (!converged) ++record_.unconverged;
}

bool FixedPoint::repeat(std::int64_t step, std::span<const Vec3> answer) {
    const Iteration& wanted = setting_.iteration;
    const auto answered = flat(answer);
    const double residual = measure(answered);
    if (!std::isfinite(residual)) {
        throw Diverged(fmt::format(
            "iteration {} of coupled step {} gave velocities that are not finite; take a "
            "smaller time.step or a coupling.iteration.relaxation below {:g}",
            iteration_ + 1, step, wanted.relaxation));
    }
    const bool converged = residual <= wanted.velocity_tolerance;
    const bool again = !converged && iteration_ + 1 < wanted.max_iterations;
    if (!converged && !again && wanted.on_no_convergence == OnNoConvergence::stop) {
        throw Diverged(fmt::format(
            "coupled step {} has not converged: after {} iterations the {} changes by "
            "{:.3g} of itself, allowed is {:.3g} "
            "(coupling.iteration.velocity_tolerance); take a smaller time.step, {}a "
            "larger coupling.iteration.max_iterations, or on_no_convergence: continue",
            step, iteration_ + 1, record_.measure, residual, wanted.velocity_tolerance,
            wanted.acceleration == AccelerationMethod::iqn_ils
                ? ""
                : "acceleration: iqn_ils, "));
    }
    convergence_.send({step, iteration_}, again);
    if (again) {
        acceleration_->improve(flat(guess_), answered);
        ++iteration_;
        return true;
    }
    acceleration_->end_step(flat(guess_), answered);
    count(residual, converged);
    return false;
}

}  // namespace magfsi::coupler
