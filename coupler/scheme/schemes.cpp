// SPDX-License-Identifier: GPL-2.0-or-later
// The two schemes (options.h), each with its own state and its own list of tasks in a
// coupled step of the structure and of the fluid. Both sides stand at t(n) before these
// tasks and at t(n+1) after "count step".
#include <fmt/format.h>

#include <algorithm>

#include "base/fitted/constants.h"
#include "coupler/scheme/fixed_point.h"
#include "coupler/scheme/fluid_coupling.h"
#include "coupler/scheme/structure_coupling.h"

namespace magfsi::coupler {

namespace {

// Serial scheme: the structure takes its step under the fluid's velocity at t(n), held or
// extrapolated; then the fluid takes its step under the impulses of the structure's step.
class SerialStructure final : public StructureCoupling {
  public:
    using StructureCoupling::StructureCoupling;

    void add_tasks(TaskList& tasks) override {
        if (extrapolates())
            tasks.add_coupling("extrapolate fluid velocity",
                               [this] { extrapolate_velocity(); });
        else
            tasks.add_coupling("take fluid velocity",
                               [this] { force_->begin_step(step_.fluid_velocity); });
        add_advance(tasks);  // from "advance structure" to "send impulses"
        add_audit(tasks);
        tasks.add_coupling("wait for fluid", [this] {
            step_.last_velocity.swap(step_.fluid_velocity);
            receive(step_.fluid_velocity);
        });
        add_end(tasks);  // from the forcing's own tasks to "count step"
    }

    std::vector<MarkerArray> carried() override {
        std::vector<MarkerArray> all = StructureCoupling::carried();
        if (extrapolates()) all.push_back({"last_velocity", flat(step_.last_velocity)});
        return all;
    }

  private:
    // Starts the force of a step with the line through the last two samples of the
    // fluid's velocity.
    void extrapolate_velocity() {
        std::vector<Vec3> end = step_.fluid_velocity;
        for (std::size_t m = 0; m < end.size(); ++m)
            end[m] += step_.fluid_velocity[m] - step_.last_velocity[m];
        force_->begin_step(step_.fluid_velocity);
        force_->let_change(step_.fluid_velocity, end);
    }
};

class SerialFluid final : public FluidCoupling {
  public:
    using FluidCoupling::FluidCoupling;

    void add_tasks(TaskList& tasks) override {
        tasks.add_coupling("wait for structure", [this] {
            receive(session_.clock().step());
            take_place();
        });
        tasks.add_immersed_boundary("spread impulses", [this] {
            boundary_->spread(batch_->before_m, batch_->impulse);
        });
        if (balance())
            tasks.add_coupling("audit interface",
                               [this] { balance()->add(boundary_->received()); });
        tasks.add(advance_fluid, [this] { advance(); });
        tasks.add("count step", [this] { session_.complete_step(); });
        tasks.add_immersed_boundary("sample velocities", [this] { sample_velocities(); });
        tasks.add_coupling("send velocities", [this] { send_velocities(); });
    }
};

// Speed [cells per step] of a fluid at rest: rounding errors of the largest speeds.
constexpr double rest_lattice_speed = 1e-9;

// Implicit scheme: both take the step under a guess of the fluid's velocities at t(n+1),
// from the same state again and again until the resulting velocities agree with the
// guess.
class ImplicitStructure : public StructureCoupling {
  public:
    ImplicitStructure(Session& session, StructureSolver& solver, const Grid& grid,
                      BodyMarkers markers)
        : StructureCoupling(session, solver, grid, std::move(markers)),
          fixed_point_(session.world(),
                       {*options_.iteration,
                        rest_lattice_speed * grid.spacing_m / session.clock().step_s(),
                        session.timeout_s()},
                       force_->markers().size()),
          answer_(force_->markers().size()) {}

    void add_tasks(TaskList& tasks) override {
        tasks.add("keep state", [this] { keep_state(); });
        const std::size_t first = tasks.size();
        tasks.add_coupling("guess fluid velocity", [this] { guess_velocity(); });
        add_advance(tasks);
        tasks.add_coupling("wait for fluid", [this] { receive_answer(); });
        tasks.add_coupling("check convergence", [this] { check_convergence(); });
        tasks.repeat_from(first, [this] { return again_; });
        add_audit(tasks);
        tasks.add_coupling("take fluid velocity", [this] { accept_answer(); });
        add_end(tasks);
    }

    std::vector<MarkerArray> carried() override {
        std::vector<MarkerArray> all = StructureCoupling::carried();
        all.push_back({"last_velocity", flat(step_.last_velocity)});
        int number = 0;
        for (const auto& vector : fixed_point_.acceleration().vectors())
            all.push_back({fmt::format("iteration_{:03d}", number++), vector});
        return all;
    }
    std::vector<double> carried_numbers() const override {
        return fixed_point_.acceleration().numbers();
    }
    void make_room(std::span<const double> numbers) override {
        fixed_point_.acceleration().make_room(numbers, 3 * answer_.size());
    }
    const output::IterationSummary* iterations() const override {
        return &fixed_point_.record();
    }

  protected:
    FixedPoint fixed_point_;
    std::vector<Vec3> answer_;  // the answer to the last guess

    virtual void accept_answer() {
        step_.last_velocity.swap(step_.fluid_velocity);
        std::ranges::copy(answered_velocity(), step_.fluid_velocity.begin());
        // The enclosed fluid took the guess for the velocity at the step's end.
        std::ranges::copy(answered_velocity(),
                          force_->enclosed().last_velocity().begin());
    }

  private:
    // Makes the first guess of a step.
    virtual void begin_iterations() {
        fixed_point_.begin_step(step_.fluid_velocity, step_.last_velocity);
    }
    virtual void receive_answer() { receive(answer_); }
    // Velocities of the fluid [m/s] that belong to the last answer.
    virtual std::span<const Vec3> answered_velocity() const { return answer_; }

    Occasion occasion() const override {
        return {session_.clock().step(), fixed_point_.iteration()};
    }

    // What a checkpoint carries is what a repeated step starts from, except the
    // iterations'.
    void keep_state() {
        solver_.keep();
        kept_m_ = step_.now_m;
        kept_.clear();
        for (const MarkerArray& array : StructureCoupling::carried())
            kept_.emplace_back(array.values.begin(), array.values.end());
        begin_iterations();
    }

    // A velocity that alternates from step to step has no mean over a step: the body
    // would not feel it, the fluid would not be held, and at low viscosity it would grow
    // (in the small swimmer by 4 % per step at strength 1). Both ends of the line from
    // U(n) to the guess are therefore drawn back by a part of the second difference, with
    // the penalty an eighth. In the mean,
    //   (3 U(n+1) + 6 U(n) - U(n-1)) / 8,
    // half of what alternates is left, and the rest is that of the line to second order.
    // Beside a body at rest that takes back s times the slip in a step, the amplification
    // of
    //   U(n+1) - U(n) = -2 s mean(U)
    // is above -1 for s < 1 / (4 drawn_back): 2 with an eighth. In forcing no_slip s is
    // 3/4 (no_slip.h) and the part a fifth, which leaves four fifths of what alternates.
    //
    // If U were held at the value of the step's end the fluid would lead the body by half
    // a step, a negative added mass of kappa dt / 2 per marker, as large as the fluid
    // that the marker moves: light sheets would diverge.
    virtual void guess_velocity() {
        const auto guess = fixed_point_.guess();
        force_->begin_step(guess);
        const double drawn_back = options_.immersed_boundary.forcing == Forcing::no_slip
                                      ? fitted::drawn_back_no_slip
                                      : fitted::drawn_back_penalty;
        std::vector<Vec3> start = step_.fluid_velocity, end(guess.begin(), guess.end());
        for (std::size_t m = 0; m < start.size(); ++m) {
            const Vec3 back =
                drawn_back * (end[m] - 2.0 * start[m] + step_.last_velocity[m]);
            start[m] -= back;
            end[m] -= back;
        }
        if (extrapolates()) return force_->let_change(start, end);
        for (std::size_t m = 0; m < start.size(); ++m)
            start[m] = 0.5 * (start[m] + end[m]);
        force_->hold(start);
    }

    void check_convergence() {
        again_ = fixed_point_.repeat(session_.clock().step(), answer_);
        if (!again_) return;
        solver_.go_back();
        step_.now_m = kept_m_;
        std::size_t number = 0;
        for (const MarkerArray& array : StructureCoupling::carried())
            std::ranges::copy(kept_[number++], array.values.begin());
    }

    bool again_ = false;  // the step is repeated
    // Positions and carried arrays of the markers at the start of the step.
    std::vector<Vec3> kept_m_;
    std::vector<std::vector<double>> kept_;
};

// The implicit scheme for forcing no_slip in a fluid whose pressure answers a force
// within the step. How much the fluid moves is known only after its pressure, so the
// iterations look for the force with which it moves as the body does. Their unknown is
// the velocity W in F = kappa (V - W), held over the step, and the answer to a guess W is
//   W + U - mean V
// with U the fluid's velocity at the step's end and mean V the markers' in the step: a
// fluid that is too slow lowers W and so raises the force on it. At the fixed point U =
// mean V, whatever kappa is; with kappa = 2 rho dV / dt over the row sum the iterations
// are few, for the fluid's answer to a change of W is between the negative of that change
// and a share of it, the cells' mass over the added mass.
//
// Why the mean of V: the impulse I of a step does the work I . mean V on the fluid, and
// the part kappa (mean V^2 - (mean V)^2) dt is lost, so that the body cannot gain energy
// of an implicit fluid. With V at the step's end elastic waves of a period below two
// steps answer with the wrong sign, and no force holds them. The fluid follows the body
// by half a step.
class ImplicitNoSlipStructure final : public ImplicitStructure {
  public:
    ImplicitNoSlipStructure(Session& session, StructureSolver& solver, const Grid& grid,
                            BodyMarkers markers)
        : ImplicitStructure(session, solver, grid, std::move(markers)),
          velocity_(answer_.size()),
          held_(answer_.size()),
          last_held_(answer_.size()) {}

    std::vector<MarkerArray> carried() override {
        std::vector<MarkerArray> all = ImplicitStructure::carried();
        all.push_back({"held_velocity", flat(held_)});
        all.push_back({"last_held_velocity", flat(last_held_)});
        return all;
    }

  private:
    void begin_iterations() override {
        if (session_.clock().step() == 0) held_ = last_held_ = step_.fluid_velocity;
        fixed_point_.begin_step(held_, last_held_);
        for (std::size_t m = 0; m < velocity_.size(); ++m)
            velocity_[m] = 2.0 * step_.fluid_velocity[m] - step_.last_velocity[m];
    }

    // The enclosed fluid takes the velocity of the iteration before.
    void guess_velocity() override {
        force_->begin_step(velocity_);
        force_->hold(fixed_point_.guess());
    }

    void receive_answer() override {
        receive(velocity_);
        const std::vector<Vec3> wanted = step_.mean_velocity();
        for (std::size_t m = 0; m < answer_.size(); ++m)
            answer_[m] = fixed_point_.guess()[m] + velocity_[m] - wanted[m];
    }

    std::span<const Vec3> answered_velocity() const override { return velocity_; }

    void accept_answer() override {
        ImplicitStructure::accept_answer();
        last_held_.swap(held_);
        std::ranges::copy(fixed_point_.guess(), held_.begin());
    }

    std::vector<Vec3> velocity_;  // U of the last answer
    // W of the last step and of the one before.
    std::vector<Vec3> held_, last_held_;
};

class ImplicitFluid final : public FluidCoupling {
  public:
    using FluidCoupling::FluidCoupling;

    void add_tasks(TaskList& tasks) override {
        tasks.add("begin iterations", [this] {
            iteration_ = 0;
            if (balance()) felt_ = boundary_->sampled_cells();
        });
        const std::size_t first = tasks.size();
        tasks.add_coupling("wait for structure", [this] { receive_markers(); });
        tasks.add_immersed_boundary("spread impulses", [this] {
            boundary_->spread(batch_->before_m, batch_->impulse);
        });
        tasks.add(advance_fluid, [this] { advance(); });
        tasks.add_immersed_boundary("sample velocities", [this] { sample_velocities(); });
        tasks.add_coupling("send velocities", [this] { send_velocities(); });
        tasks.add_coupling("wait for convergence check", [this] { check_convergence(); });
        tasks.repeat_from(first, [this] { return again_; });
        if (balance())
            tasks.add_coupling("audit interface",
                               [this] { balance()->add(boundary_->received(felt_)); });
        tasks.add("count step", [this] { session_.complete_step(); });
    }

  private:
    // After a move of the grid the cells of felt_ are others: their velocities are
    // sampled again.
    void receive_markers() {
        receive({session_.clock().step(), iteration_});
        if (take_place() && !felt_.empty()) {
            boundary_->sample(batch_->before_m, batch_->volume_m3);
            felt_ = boundary_->sampled_cells();
        }
        if (iteration_ == 0) fluid_.keep();
    }

    void check_convergence() {
        again_ = step_is_repeated(session_.world(), {session_.clock().step(), iteration_},
                                  session_.timeout_s());
        if (!again_) return;
        fluid_.go_back();
        boundary_->fluid_has_changed();
        ++iteration_;
    }

    int iteration_ = 0;
    bool again_ = false;  // the step is repeated
    // Velocities of the cells at t(n) [m/s], for the audit only.
    std::vector<double> felt_;
};

}  // namespace

std::unique_ptr<StructureCoupling> make_structure_coupling(Session& session,
                                                           StructureSolver& solver,
                                                           const Grid& grid,
                                                           BodyMarkers markers) {
    if (session.plan().coupling->scheme == Scheme::serial)
        return std::make_unique<SerialStructure>(session, solver, grid,
                                                 std::move(markers));
    if (session.plan().fluid_is_incompressible &&
        session.plan().coupling->immersed_boundary.forcing == Forcing::no_slip)
        return std::make_unique<ImplicitNoSlipStructure>(session, solver, grid,
                                                         std::move(markers));
    return std::make_unique<ImplicitStructure>(session, solver, grid, std::move(markers));
}
std::unique_ptr<FluidCoupling> make_fluid_coupling(Session& session, GridFluid& fluid) {
    if (session.plan().coupling->scheme == Scheme::serial)
        return std::make_unique<SerialFluid>(session, fluid);
    return std::make_unique<ImplicitFluid>(session, fluid);
}

}  // namespace magfsi::coupler
