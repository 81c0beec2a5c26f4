// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/scheme/structure_coupling.h"

namespace magfsi::coupler {

namespace {

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
      step_{solver, session.clock().step_s()},
      markers_(std::move(markers)),
      slip_(std::move(markers_.areas)),
      exchange_(session.world(), grid, options_.immersed_boundary.kernel,
                session.timeout_s(), options_.immersed_boundary.forcing.value(),
                markers_.bodies, bodies_of(markers_.markers)),
      start_velocity_(markers_.off_nodes_kg.size()) {
    make_force();
    step_.fluid_velocity.resize(force_->markers().size());
    step_.last_velocity = step_.fluid_velocity;
    if (session.plan().interface_balance) balance_ = std::make_unique<BalanceRecord>();
    if (markers_.measures_work)
        work_ = std::make_unique<MarkerWork>(force_->markers().size());
    attach_force();
}

void StructureCoupling::make_force() {
    const PenaltyScale scale = penalty_scale(session_);
    if (options_.immersed_boundary.forcing == Forcing::penalty) {
        force_ = std::make_unique<PenaltyForcing>(std::move(markers_.markers), scale,
                                                  markers_.gravity_m_s2, step_);
        return;
    }
    const NoSlipForcing::Setting setting{
        markers_.slip_rates, session_.plan().fluid_body_force_n_m3,
        markers_.carries_layers, slip_.areas(), session_.plan().fluid_is_incompressible};
    force_ = std::make_unique<NoSlipForcing>(std::move(markers_.markers), scale,
                                             markers_.gravity_m_s2, step_, setting);
}

void StructureCoupling::attach_force() {
    PenaltyForce& law = *force_;
    if (!work_)
        return solver_.attach_fluid_force(
            [&law](const double* velocity, double* force, double substep_s) {
                law.apply(velocity, force, substep_s);
            });
    solver_.attach_fluid_force(
        [&law, &work = *work_](const double* velocity, double* force, double substep_s) {
            law.apply(velocity, force, substep_s);
            work.add_substep(law, velocity, substep_s);
        });
}

std::vector<Vec3> StructureCoupling::marker_positions() const {
    std::vector<Vec3> positions;
    positions.reserve(force_->markers().size());
    for (const Marker& marker : force_->markers())
        positions.push_back(at_marker(marker, solver_.positions()));
    return positions;
}

void StructureCoupling::begin() {
    step_.now_m = marker_positions();
    step_.before_m = step_.now_m;
    exchange_.send(-1, step_.before_m, force_->given(), step_.now_m,
                   force_->volumes_m3());
    std::vector<Vec3> first(step_.now_m.size());
    exchange_.receive(-1, first, force_->answer());
    // A checkpoint has the velocities already; the exchange was for the forcing's answer.
    const bool fresh = session_.restart() == nullptr;
    if (fresh) {
        step_.last_velocity = first;
        step_.fluid_velocity = std::move(first);
    }
    force_->start(fresh);
}

void StructureCoupling::add_advance(TaskList& tasks) {
    if (work_) tasks.add_output("begin audit of work", [this] { work_->begin_step(); });
    if (markers_.measures_force)
        tasks.add_output("note velocities", [this] { note_velocities(); });
    tasks.add(advance_structure, [this] {
        solver_.advance();
        ++advances_;
    });
    tasks.add(check_finite, [this] { solver_.check_finite(session_.clock().step()); });
    tasks.add_coupling("move markers", [this] {
        step_.before_m = std::move(step_.now_m);
        step_.now_m = marker_positions();
    });
    force_->add_to_advance(tasks);
    if (work_ && markers_.carries_layers)
        tasks.add_output("audit layers", [this] {
            work_->add_given(force_->given(), force_->impulse(), step_.mean_velocity());
        });
    tasks.add_coupling("send impulses", [this] {
        exchange_.send(occasion(), step_.before_m, force_->given(), step_.now_m,
                       force_->volumes_m3());
    });
}

void StructureCoupling::note_velocities() {
    solver_.renew_ghost_velocities();
    for (std::size_t m = 0; m < start_velocity_.size(); ++m)
        start_velocity_[m] = at_marker(force_->markers()[m], solver_.velocities());
}

void StructureCoupling::add_audit(TaskList& tasks) {
    if (!balance_) return;
    tasks.add_coupling("audit interface", [this] {
        InterfaceBalance sum;
        const auto given = force_->given();
        for (std::size_t m = 0; m < given.size(); ++m)
            add_marker(sum, given[m], step_.fluid_velocity[m]);
        balance_->add(sum);
    });
}

void StructureCoupling::add_end(TaskList& tasks) {
    force_->add_to_answer(tasks);
    tasks.add_output("measure slip", [this] {
        if ((session_.clock().step() + 1) % markers_.steps_between_slip_samples == 0)
            force_->measure(slip_);
    });
    tasks.add("count step", [this] { session_.complete_step(); });
}

std::vector<MarkerArray> StructureCoupling::carried() {
    std::vector<MarkerArray> all = force_->carried();
    all.insert(all.begin(), {"fluid_velocity", flat(step_.fluid_velocity)});
    if (!work_) return all;
    all.push_back({"works", flat(work_->works())});
    all.push_back({"fluid_force", flat(work_->last_fluid_force())});
    all.push_back({"enclosed_force", flat(work_->last_enclosed_force())});
    return all;
}

void StructureCoupling::shorten_last_step(double part) {
    const auto closer = [&](std::span<Vec3> last) {
        for (std::size_t m = 0; m < last.size(); ++m) {
            const Vec3& now = step_.fluid_velocity[m];
            last[m] = now + part * (last[m] - now);
        }
    };
    closer(force_->enclosed().last_velocity());
    closer(step_.last_velocity);
}

SlipReport StructureCoupling::slip() const {
    return slip_.collect(session_.world().local());
}

}  // namespace magfsi::coupler
