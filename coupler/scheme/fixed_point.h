// SPDX-License-Identifier: GPL-2.0-or-later
// The implicit step as a fixed point for the fluid's velocities at the markers at its
// end: guess, residual, convergence check, next guess. On the structure's ranks, each
// with its own markers.
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

// In an implicit scheme the structure decides whether a step is repeated, and the fluid
// learns it by a message. The structure's end; only its root sends.
class ConvergenceSender {
  public:
    ConvergenceSender(const World& world, double timeout_s);
    ~ConvergenceSender();
    ConvergenceSender(const ConvergenceSender&) = delete;
    ConvergenceSender& operator=(const ConvergenceSender&) = delete;

    void send(const Occasion& when, bool again);

  private:
    const World& world_;
    double timeout_s_;
    std::array<std::int64_t, 3> note_{};  // step, iteration, again
    MPI_Request sending_ = MPI_REQUEST_NULL;
};

// The fluid's end: whether the step is repeated. Collective over the fluid. Throws
// PartnerLost when the message is of another step or iteration.
bool step_is_repeated(const World& world, const Occasion& when, double timeout_s);

class FixedPoint {
  public:
    struct Setting {
        Iteration iteration;
        // Velocities below are at rest: residuals are measured by it there [m/s].
        double rest_m_s = 0;
        double timeout_s = 0;
    };

    // markers: of this rank. Collective over the structure.
    FixedPoint(const World& world, const Setting& setting, std::size_t markers);

    // The first guess, from the velocities at the step's start and those a step earlier.
    void begin_step(std::span<const Vec3> now, std::span<const Vec3> before);

    std::span<const Vec3> guess() const { return guess_; }
    int iteration() const { return iteration_; }  // from 0 in each step

    // Takes the fluid's answer to the guess and tells the fluid whether the step is
    // repeated, which is returned; the next guess is ready then. Throws Diverged when a
    // step has not converged and the scene says to stop, or when the answer is not
    // finite. Collective over the structure.
    bool repeat(std::int64_t step, std::span<const Vec3> answer);

    // What it took so far.
    const output::IterationSummary& record() const { return record_; }

    // For checkpoints.
    Acceleration& acceleration() { return *acceleration_; }
    const Acceleration& acceleration() const { return *acceleration_; }

  private:
    double measure(std::span<const double> answer) const;
    void count(double residual, bool converged);

    const World& world_;
    Setting setting_;
    double rest_norm_m_s_ = 0;  // of all markers' velocities
    std::unique_ptr<Acceleration> acceleration_;
    ConvergenceSender convergence_;
    std::vector<Vec3> guess_;
    int iteration_ = 0;
    output::IterationSummary record_;
};

}  // namespace magfsi::coupler
