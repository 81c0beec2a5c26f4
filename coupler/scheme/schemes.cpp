// SPDX-License-Identifier: GPL-2.0-or-later
// The two schemes: the tasks of a coupled step of the structure and of the fluid. Both
// sides stand at t(n) before these tasks and at t(n+1) after "count step".
#include "coupler/scheme/fluid_coupling.h"
#include "coupler/scheme/structure_coupling.h"

namespace magfsi::coupler {

// Serial scheme: the structure takes its step under the fluid's velocity at t(n); then
// the fluid takes its step under the impulses of the structure's step.
void StructureCoupling::add_serial(TaskList& tasks) {
    if (extrapolates())
        tasks.add_coupling("extrapolate fluid velocity",
                           [this] { extrapolate_velocity(); });
    else
        tasks.add_coupling("take fluid velocity",
                           [this] { begin_force(fluid_velocity_); });
    add_advance(tasks);
    tasks.add_coupling("send impulses", [this] { send_impulses(); });
    if (balance_) tasks.add_coupling("audit interface", [this] { audit(); });
    tasks.add_coupling("wait for fluid", [this] { receive_velocities(); });
    tasks.add_output("measure slip", [this] { measure_slip(); });
    tasks.add("count step", [this] { session_.complete_step(); });
}
void FluidCoupling::add_serial(TaskList& tasks) {
    tasks.add_coupling("wait for structure", [this] { receive_markers(); });
    tasks.add_immersed_boundary("spread impulses", [this] { spread_impulses(); });
    if (balance_)
        tasks.add_coupling("audit interface", [this] { audit(boundary_.received()); });
    tasks.add(advance_fluid, [this] { advance(); });
    tasks.add("count step", [this] { session_.complete_step(); });
    tasks.add_immersed_boundary("sample velocities", [this] { sample_velocities(); });
    tasks.add_coupling("send velocities", [this] { send_velocities(); });
}

// Implicit scheme: both take the step under a guess of the fluid's velocities at t(n+1),
// from the same state again and again until the resulting velocities agree with the
// guess.
void StructureCoupling::add_implicit(TaskList& tasks) {
    tasks.add("keep state", [this] { keep_state(); });
    const std::size_t first = tasks.size();
    tasks.add_coupling("guess fluid velocity", [this] { guess_velocity(); });
    add_advance(tasks);
    tasks.add_coupling("send impulses", [this] { send_impulses(); });
    tasks.add_coupling("wait for fluid", [this] { receive_velocities(); });
    tasks.add_coupling("check convergence", [this] { check_convergence(); });
    tasks.repeat_from(first, [this] { return again_; });
    if (balance_) tasks.add_coupling("audit interface", [this] { audit(); });
    tasks.add_coupling("take fluid velocity", [this] { accept_answer(); });
    tasks.add_output("measure slip", [this] { measure_slip(); });
    tasks.add("count step", [this] { session_.complete_step(); });
}
void FluidCoupling::add_implicit(TaskList& tasks) {
    tasks.add("begin iterations", [this] { begin_iterations(); });
    const std::size_t first = tasks.size();
    tasks.add_coupling("wait for structure", [this] { receive_markers(); });
    tasks.add_immersed_boundary("spread impulses", [this] { spread_impulses(); });
    tasks.add(advance_fluid, [this] { advance(); });
    tasks.add_immersed_boundary("sample velocities", [this] { sample_velocities(); });
    tasks.add_coupling("send velocities", [this] { send_velocities(); });
    tasks.add_coupling("wait for convergence check", [this] { check_convergence(); });
    tasks.repeat_from(first, [this] { return again_; });
    if (balance_)
        tasks.add_coupling("audit interface",
                           [this] { audit(boundary_.received(felt_)); });
    tasks.add("count step", [this] { session_.complete_step(); });
}

void StructureCoupling::add_advance(TaskList& tasks) {
    tasks.add(advance_structure, [this] {
        solver_.advance();
        ++advances_;
    });
    tasks.add(check_finite, [this] { solver_.check_finite(session_.clock().step()); });
}

void StructureCoupling::add_tasks(TaskList& tasks) {
    if (options_.scheme == Scheme::serial) return add_serial(tasks);
    add_implicit(tasks);
}
void FluidCoupling::add_tasks(TaskList& tasks) {
    if (options_.scheme == Scheme::serial) return add_serial(tasks);
    add_implicit(tasks);
}

}  // namespace magfsi::coupler
