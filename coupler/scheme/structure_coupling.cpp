// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/structure_coupling.h"
#include "base/fitted/constants.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::coupler {

namespace {

// Speed [cells per step] of a fluid at rest: rounding errors of the largest speeds.
constexpr double rest_lattice_speed = 1e-9;

// A velocity that alternates from step to step has no mean over a step: the body would
// not feel it, the fluid would not be held, and at low viscosity it would grow (in the
// small swimmer by 4 % per step at strength 1). Both ends of the line from U(n) to the
// guess are therefore drawn back by a part of the second difference, with the penalty an
// eighth. In the mean,
//   (3 U(n+1) + 6 U(n) - U(n-1)) / 8,
// half of what alternates is left, and the rest is that of the line to second order.
// Beside a body at rest that takes back s times the slip in a step, the amplification of
//   U(n+1) - U(n) = -2 s mean(U)
// is above -1 for s < 1 / (4 drawn_back): 2 with an eighth. In forcing no_slip s is 3/4
// (no_slip.h) and the part a fifth, which leaves four fifths of what alternates.

struct Line {
    std::vector<Vec3> start, end;
};

Line line_to(std::span<const Vec3> guess, std::span<const Vec3> now,
             std::span<const Vec3> before, double drawn_back) {
    Line line{{now.begin(), now.end()}, {guess.begin(), guess.end()}};
    for (std::size_t m = 0; m < now.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double back = drawn_back * (guess[m][d] - 2 * now[m][d] + before[m][d]);
            line.start[m][d] -= back;
            line.end[m][d] -= back;
        }
    }
    return line;
}

std::vector<Vec3> mean(std::span<const Vec3> a, std::span<const Vec3> b) {
    std::vector<Vec3> all(a.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) all[m][d] = 0.5 * (a[m][d] + b[m][d]);
    }
    return all;
}

PenaltyScale penalty_scale(const Session& session) {
    const RunPlan& plan = session.plan();
    PenaltyScale scale{plan.coupling->immersed_boundary.strength,
                       plan.fluid_density_kg_m3, session.clock().step_s()};
    if (plan.coupling->scheme == Scheme::implicit) scale.enclosed_follow.part = 1;
    return scale;
}

std::vector<int> bodies_of(std::span<const Marker> markers) {
    std::vector<int> bodies;
    for (const Marker& marker : markers) bodies.push_back(marker.body);
    return bodies;
}

}  // namespace

StructureCoupling::StructureCoupling(Session& session, StructureSolver& solver,
                                     const Grid& grid, BodyMarkers markers)
    : session_(session),
      solver_(solver),
      options_(*session.plan().coupling),
      markers_(std::move(markers)),
      force_(std::move(markers_.markers), penalty_scale(session), markers_.gravity_m_s2),
      exchange_(session.world(), grid, options_.immersed_boundary.kernel,
                session.timeout_s(), options_.immersed_boundary.forcing.value(),
                markers_.bodies, bodies_of(force_.markers())),
      slip_(std::move(markers_.areas)) {
    const std::size_t count = force_.markers().size();
    if (options_.immersed_boundary.forcing == Forcing::no_slip)
        no_slip_ = std::make_unique<NoSlip>(force_.markers(), markers_.slip_rates);
    if (markers_.carries_layers)
        layer_ = std::make_unique<LayerInertia>(force_.markers(), slip_.areas(),
                                                session.plan().fluid_density_kg_m3);
    if (session.plan().interface_balance) balance_ = std::make_unique<BalanceRecord>();
    if (markers_.measures_work) work_ = std::make_unique<MarkerWork>(count);
    fluid_velocity_.resize(count);
    start_velocity_.resize(markers_.off_nodes_kg.size());
    if (options_.scheme == Scheme::implicit || extrapolates())
        last_velocity_.resize(count);
    if (options_.scheme == Scheme::implicit) {
        const double rest_m_s =
            rest_lattice_speed * grid.spacing_m / session.clock().step_s();
        fixed_point_ = std::make_unique<FixedPoint>(
            session.world(),
            FixedPoint::Setting{*options_.iteration, rest_m_s, session.timeout_s()},
            count);
        answer_.resize(count);
    }
    solver_.attach_fluid_force(
        [this](const double* velocity, double* force, double substep_s) {
            force_.apply(velocity, force, substep_s);
            if (work_) work_->add_substep(force_, velocity, substep_s);
        });
}

std::vector<Vec3> StructureCoupling::marker_positions() const {
    std::vector<Vec3> positions;
    positions.reserve(force_.markers().size());
    for (const Marker& marker : force_.markers())
        positions.push_back(at_marker(marker, solver_.positions()));
    return positions;
}

StructureCoupling::NoSlip::NoSlip(std::span<const Marker> markers, const SlipRates& rates)
    : memory(markers, rates) {
    for (const Marker& m : markers) volume_m3.push_back(m.volume_m3);
}

std::span<const double> StructureCoupling::volumes_m3() const {
    return no_slip_ ? no_slip_->volume_m3 : std::span<const double>();
}

void StructureCoupling::receive(const Occasion& when, std::span<Vec3> velocity) {
    exchange_.receive(when, velocity, no_slip_ ? &no_slip_->answer : nullptr);
}

void StructureCoupling::begin() {
    now_m_ = marker_positions();
    before_m_ = now_m_;
    const std::vector<Vec3> none(now_m_.size());
    exchange_.send(-1, before_m_, none, now_m_, volumes_m3());
    std::vector<Vec3> first(now_m_.size());
    receive(-1, first);
    if (no_slip_) force_.divide_by(no_slip_->answer.row_sum);
    // A checkpoint has the velocities already; the exchange was for the row sums.
    if (session_.restart()) return;
    fluid_velocity_ = std::move(first);
    force_.enclosed().start(fluid_velocity_);
    if (layer_) layer_->start(fluid_velocity_, solver_.positions());
    if (!last_velocity_.empty()) last_velocity_ = fluid_velocity_;
}

void StructureCoupling::begin_force(std::span<const Vec3> fluid_velocity) {
    if (work_) work_->begin_step();
    if (markers_.measures_force) {
        solver_.renew_ghost_velocities();
        for (std::size_t m = 0; m < start_velocity_.size(); ++m)
            start_velocity_[m] = at_marker(force_.markers()[m], solver_.velocities());
    }
    force_.begin_step(fluid_velocity);
    if (no_slip_) hold(fluid_velocity);
}

void StructureCoupling::hold(std::span<const Vec3> fluid_velocity) {
    if (!no_slip_) return force_.hold(fluid_velocity);
    force_.hold(no_slip_->memory.felt(fluid_velocity));
}

void StructureCoupling::let_change(std::span<const Vec3> start,
                                   std::span<const Vec3> end) {
    if (!no_slip_) return force_.let_change(start, end);
    force_.let_change(no_slip_->memory.felt(start), no_slip_->memory.felt(end));
}

// Updates the no_slip memory; the body force's part of q - U is left out of g.
void StructureCoupling::take_answer(std::span<const Vec3> felt) {
    if (!no_slip_) return;
    const auto& [row_sum, passed] = no_slip_->answer;
    const RunPlan& plan = session_.plan();
    const double half_m3_kg = 0.5 / plan.fluid_density_kg_m3;
    std::vector<Vec3> uneven(felt.size());
    for (std::size_t m = 0; m < felt.size(); ++m) {
        const double even = half_m3_kg * row_sum[m] / force_.markers()[m].volume_m3;
        for (std::size_t d = 0; d < 3; ++d) {
            const double of_all =
                half_m3_kg * session_.clock().step_s() * plan.fluid_body_force_n_m3[d];
            uneven[m][d] = even * given()[m][d] - (passed[m][d] - of_all - felt[m][d]);
        }
    }
    no_slip_->memory.add(mean_velocity(), passed, uneven);
    force_.divide_by(row_sum);
}

// Mean velocity of the markers in the step that has been done.
std::vector<Vec3> StructureCoupling::mean_velocity() const {
    const double step_s = session_.clock().step_s();
    std::vector<Vec3> all(now_m_.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            all[m][d] = (now_m_[m][d] - before_m_[m][d]) / step_s;
    }
    return all;
}

bool StructureCoupling::extrapolates() const {
    return options_.sampled_velocity == SampledVelocity::linear;
}

void StructureCoupling::extrapolate_velocity() {
    std::vector<Vec3> end = fluid_velocity_;
    for (std::size_t m = 0; m < end.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            end[m][d] += fluid_velocity_[m][d] - last_velocity_[m][d];
    }
    begin_force(fluid_velocity_);
    let_change(fluid_velocity_, end);
    last_velocity_ = fluid_velocity_;
}

void StructureCoupling::send_impulses() {
    before_m_ = std::move(now_m_);
    now_m_ = marker_positions();
    if (layer_) {
        const std::vector<Vec3> velocity = mean_velocity();
        layer_->add(force_.impulse(), velocity, solver_.positions());
        if (work_) work_->add_given(layer_->given(), force_.impulse(), velocity);
    }
    exchange_.send({session_.clock().step(), iteration()}, before_m_, given(), now_m_,
                   volumes_m3());
}

void StructureCoupling::audit() {
    InterfaceBalance sum;
    for (std::size_t m = 0; m < given().size(); ++m)
        add_marker(sum, given()[m], fluid_velocity_[m]);
    balance_->add(sum);
}

void StructureCoupling::receive_velocities() {
    const std::vector<Vec3> felt = fluid_velocity_;
    receive({session_.clock().step(), iteration()},
            fixed_point_ ? answer_ : fluid_velocity_);
    if (!fixed_point_) take_answer(felt);
}

void StructureCoupling::measure_slip() {
    if ((session_.clock().step() + 1) % markers_.steps_between_slip_samples != 0) return;
    if (no_slip_)
        return slip_.add(force_.markers(), no_slip_->answer.passed, mean_velocity(),
                         solver_.positions());
    solver_.renew_ghost_velocities();
    std::vector<Vec3> velocity;
    for (const Marker& marker : force_.markers())
        velocity.push_back(at_marker(marker, solver_.velocities()));
    slip_.add(force_.markers(), fluid_velocity_, velocity, solver_.positions());
}

void StructureCoupling::keep_state() {
    solver_.keep();
    kept_.enclosed = force_.enclosed();
    if (layer_) kept_.layer = *layer_;
    if (work_) kept_.work = *work_;
    kept_.markers_m = now_m_;
    fixed_point_->begin_step(fluid_velocity_, last_velocity_);
}

void StructureCoupling::guess_velocity() {
    const auto guess = fixed_point_->guess();
    begin_force(guess);
    const Line line =
        line_to(guess, fluid_velocity_, last_velocity_,
                no_slip_ ? fitted::drawn_back_no_slip : fitted::drawn_back_penalty);
    // If U were held at the value of the step's end the fluid would lead the body by half
    // a step, a negative added mass of kappa dt / 2 per marker, as large as the fluid
    // that the marker moves: light sheets would diverge.
    if (extrapolates())
        let_change(line.start, line.end);
    else
        hold(mean(line.start, line.end));
}

void StructureCoupling::check_convergence() {
    again_ = fixed_point_->repeat(session_.clock().step(), answer_);
    if (!again_) return;
    solver_.go_back();
    force_.enclosed() = *kept_.enclosed;
    if (layer_) *layer_ = *kept_.layer;
    if (work_) *work_ = *kept_.work;
    now_m_ = kept_.markers_m;
}

void StructureCoupling::accept_answer() {
    last_velocity_ = fluid_velocity_;
    fluid_velocity_ = answer_;
    // The enclosed fluid took the guess for the velocity at the step's end.
    std::ranges::copy(fluid_velocity_, force_.enclosed().last_velocity().begin());
    take_answer(last_velocity_);
}

std::vector<StructureCoupling::MarkerArray> StructureCoupling::carried() {
    std::vector<MarkerArray> all{
        {"fluid_velocity", flat(fluid_velocity_)},
        {"enclosed_velocity", flat(force_.enclosed().last_velocity())},
        {"enclosed_acceleration", flat(force_.enclosed().mean())},
        {"enclosed_mean_acceleration", flat(force_.enclosed().mean_of_mean())}};
    if (!last_velocity_.empty()) all.push_back({"last_velocity", flat(last_velocity_)});
    if (no_slip_) all.push_back({"slip_memory", flat(no_slip_->memory.values())});
    if (layer_) {
        all.push_back({"layer_velocity_along", flat(layer_->last_along())});
        all.push_back({"layer_change", flat(layer_->mean())});
        all.push_back({"layer_mean_change", flat(layer_->mean_of_mean())});
    }
    if (work_) {
        all.push_back({"works", flat(work_->works())});
        all.push_back({"fluid_force", flat(work_->last_fluid_force())});
        all.push_back({"enclosed_force", flat(work_->last_enclosed_force())});
    }
    if (!fixed_point_) return all;
    int number = 0;
    for (const auto& vector : fixed_point_->acceleration().vectors())
        all.push_back({fmt::format("iteration_{:03d}", number++), vector});
    return all;
}

void StructureCoupling::shorten_last_step(double part) {
    const auto closer = [&](std::span<Vec3> last) {
        for (std::size_t m = 0; m < last.size(); ++m) {
            for (std::size_t d = 0; d < 3; ++d)
                last[m][d] =
                    fluid_velocity_[m][d] + part * (last[m][d] - fluid_velocity_[m][d]);
        }
    };
    closer(force_.enclosed().last_velocity());
    closer(last_velocity_);
}

std::vector<double> StructureCoupling::carried_numbers() const {
    if (!fixed_point_) return {};
    return fixed_point_->acceleration().numbers();
}

void StructureCoupling::make_room(std::span<const double> numbers) {
    fixed_point_->acceleration().make_room(numbers, 3 * force_.markers().size());
}

const output::IterationSummary* StructureCoupling::iterations() const {
    return fixed_point_ ? &fixed_point_->record() : nullptr;
}

SlipReport StructureCoupling::slip() const {
    return slip_.collect(session_.world().local());
}

}  // namespace magfsi::coupler
