// SPDX-License-Identifier: GPL-2.0-or-later
// The implicit step as a fixed point for the fluid's velocities at the markers at its
// end: guess, residual, convergence check and next guess. It runs on the structure's
// ranks, each with its own markers.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "coupler/exchange/exchange.h"
#include "coupler/output/summary.h"
#include "coupler/scheme/acceleration.h"

namespace magfsi::coupler {

// The structure's end of the convergence message: in the implicit scheme the structure
// decides whether a step is repeated and tells the fluid. Only its root sends.
class ConvergenceSender {
  public:
    // timeout_s: longest wait for the message before to be received [s].
    ConvergenceSender(const World& world, double timeout_s);
    ~ConvergenceSender();
    ConvergenceSender(const ConvergenceSender&) = delete;
    ConvergenceSender& operator=(const ConvergenceSender&) = delete;

    // Starts to send the decision of an iteration; again: the step is repeated.
    void send(const Occasion& when, bool again);

  private:
    const World& world_;
    double timeout_s_;
    std::array<std::int64_t, 3> note_{};  // step, iteration, 1 if repeated
    MPI_Request sending_ = MPI_REQUEST_NULL;
};

// The fluid's end: receives the decision and returns true if the step is repeated. Throws
// PartnerLost if the message is of another step or iteration. Collective over the fluid.
bool step_is_repeated(const World& world, const Occasion& when, double timeout_s);

// The iterations of one coupled step after the other.
class FixedPoint {
  public:
    struct Setting {
        Iteration iteration;
        // Velocity [m/s] below which the fluid counts as at rest: residuals are never
        // measured relative to less than this.
        double rest_m_s = 0;
        double timeout_s = 0;
    };

    // markers: number of this rank's markers. Collective over the structure.
    FixedPoint(const World& world, const Setting& setting, std::size_t markers);

    // Makes the first guess, from the velocities [m/s] at the start of the step and at
    // the start of the step before.
    void begin_step(std::span<const Vec3> now, std::span<const Vec3> before);

    // Guess of the fluid's velocities at the end of the step [m/s], by marker.
    std::span<const Vec3> guess() const { return guess_; }
    int iteration() const { return iteration_; }  // counts from 0 in each step

    // Takes the fluid's answer to the guess [m/s] and tells the fluid whether the step is
    // repeated. Returns true if so; the next guess is then ready. Throws Diverged if a
    // step has not converged and the scene asks to stop then, or if the answer is not
    // finite. Collective over the structure.
    bool repeat(std::int64_t step, std::span<const Vec3> answer);

    // Statistics of all steps so far.
    const output::IterationSummary& record() const { return record_; }

    // State for checkpoints.
    Acceleration& acceleration() { return *acceleration_; }
    const Acceleration& acceleration() const { return *acceleration_; }

  private:
    // Norm of the residual over that of the answer, over all markers.
    double measure(std::span<const double> answer) const;
    void count(double residual, bool converged);

    const World& world_;
    Setting setting_;
    // Norm of rest_m_s at all markers of all ranks [m/s].
    double rest_norm_m_s_ = 0;
    std::unique_ptr<Acceleration> acceleration_;
    ConvergenceSender convergence_;
    std::vector<Vec3> guess_;
    int iteration_ = 0;
    output::IterationSummary record_;
};

}  // namespace magfsi::coupler
