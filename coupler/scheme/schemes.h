// SPDX-License-Identifier: GPL-2.0-or-later
// The two schemes (options.h), each with its own state and its own list of tasks on
// either side. schemes.cpp has the lists.
#pragma once

#include <vector>

#include "coupler/scheme/fixed_point.h"
#include "coupler/scheme/fluid_coupling.h"
#include "coupler/scheme/structure_coupling.h"

namespace magfsi::coupler {

// Serial scheme: the structure takes its step under the fluid's velocity at t(n), held or
// extrapolated; then the fluid takes its step under the impulses of the structure's step.
class SerialStructure final : public StructureCoupling {
  public:
    using StructureCoupling::StructureCoupling;
    void add_tasks(TaskList& tasks) override;
    std::vector<MarkerArray> carried() override;

  private:
    // Starts the force of a step with the line through the last two samples of the
    // fluid's velocity.
    void extrapolate_velocity();
};

class SerialFluid final : public FluidCoupling {
  public:
    using FluidCoupling::FluidCoupling;
    void add_tasks(TaskList& tasks) override;
};

// Implicit scheme: both take the step under a guess of the fluid's velocities at t(n+1),
// from the same state again and again until the resulting velocities agree with the
// guess.
class ImplicitStructure final : public StructureCoupling {
  public:
    ImplicitStructure(Session& session, StructureSolver& solver, const Grid& grid,
                      BodyMarkers markers);
    void add_tasks(TaskList& tasks) override;
    std::vector<MarkerArray> carried() override;
    std::vector<double> carried_numbers() const override;
    void make_room(std::span<const double> numbers) override;
    const output::IterationSummary* iterations() const override {
        return &fixed_point_.record();
    }

  private:
    Occasion occasion() const override {
        return {session_.clock().step(), fixed_point_.iteration()};
    }
    void keep_state();
    void guess_velocity();
    void check_convergence();
    void accept_answer();

    FixedPoint fixed_point_;
    // Positions and carried arrays of the markers at the start of the step.
    std::vector<Vec3> kept_m_;
    std::vector<std::vector<double>> kept_;
    std::vector<Vec3> answer_;  // the fluid's answer to the last guess
    bool again_ = false;        // the step is repeated
};

class ImplicitFluid final : public FluidCoupling {
  public:
    using FluidCoupling::FluidCoupling;
    void add_tasks(TaskList& tasks) override;

  private:
    void begin_iterations();
    void receive_markers();
    void check_convergence();

    int iteration_ = 0;
    bool again_ = false;  // the step is repeated
    // Velocities of the cells at t(n) [m/s], for the audit only.
    std::vector<double> felt_;
};

}  // namespace magfsi::coupler
