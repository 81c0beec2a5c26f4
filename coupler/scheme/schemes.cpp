// SPDX-License-Identifier: GPL-2.0-or-later
// The tasks of a coupled step of the structure and of the fluid in each scheme. Both
// sides stand at t(n) before these tasks and at t(n+1) after "count step".
#include "coupler/scheme/schemes.h"

namespace magfsi::coupler {

void SerialStructure::add_tasks(TaskList& tasks) {
    if (options_.sampled_velocity == SampledVelocity::linear)
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
    add_end(tasks);  // from the forcing's view of the answer to "count step"
}
void SerialFluid::add_tasks(TaskList& tasks) {
    tasks.add_coupling("wait for structure", [this] {
        receive(session_.clock().step());
        take_place();
    });
    add_spread(tasks);  // "spread impulses"
    add_audit(tasks, [this] { return boundary_->received(); });
    add_advance(tasks);
    tasks.add("count step", [this] { session_.complete_step(); });
    add_answer(tasks);  // "sample velocities" and "send velocities"
}

void ImplicitStructure::add_tasks(TaskList& tasks) {
    tasks.add("keep state", [this] { keep_state(); });
    const std::size_t first = tasks.size();
    tasks.add_coupling("guess fluid velocity", [this] { guess_velocity(); });
    add_advance(tasks);
    tasks.add_coupling("wait for fluid", [this] { receive(answer_); });
    tasks.add_coupling("check convergence", [this] { check_convergence(); });
    tasks.repeat_from(first, [this] { return again_; });
    add_audit(tasks);
    tasks.add_coupling("take fluid velocity", [this] { accept_answer(); });
    add_end(tasks);
}
void ImplicitFluid::add_tasks(TaskList& tasks) {
    tasks.add("begin iterations", [this] { begin_iterations(); });
    const std::size_t first = tasks.size();
    tasks.add_coupling("wait for structure", [this] { receive_markers(); });
    add_spread(tasks);
    add_advance(tasks);
    add_answer(tasks);
    tasks.add_coupling("wait for convergence check", [this] { check_convergence(); });
    tasks.repeat_from(first, [this] { return again_; });
    add_audit(tasks, [this] { return boundary_->received(felt_); });
    tasks.add("count step", [this] { session_.complete_step(); });
}

std::unique_ptr<StructureCoupling> make_structure_coupling(Session& session,
                                                           StructureSolver& solver,
                                                           const Grid& grid,
                                                           BodyMarkers markers) {
    if (session.plan().coupling->scheme == Scheme::serial)
        return std::make_unique<SerialStructure>(session, solver, grid,
                                                 std::move(markers));
    return std::make_unique<ImplicitStructure>(session, solver, grid, std::move(markers));
}
std::unique_ptr<FluidCoupling> make_fluid_coupling(Session& session, GridFluid& fluid) {
    if (session.plan().coupling->scheme == Scheme::serial)
        return std::make_unique<SerialFluid>(session, fluid);
    return std::make_unique<ImplicitFluid>(session, fluid);
}

void SerialStructure::extrapolate_velocity() {
    std::vector<Vec3> end = step_.fluid_velocity;
    for (std::size_t m = 0; m < end.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            end[m][d] += step_.fluid_velocity[m][d] - step_.last_velocity[m][d];
    }
    force_->begin_step(step_.fluid_velocity);
    force_->let_change(step_.fluid_velocity, end);
}

std::vector<MarkerArray> SerialStructure::carried() {
    std::vector<MarkerArray> all = StructureCoupling::carried();
    if (options_.sampled_velocity == SampledVelocity::linear)
        all.push_back({"last_velocity", flat(step_.last_velocity)});
    return all;
}

}  // namespace magfsi::coupler
