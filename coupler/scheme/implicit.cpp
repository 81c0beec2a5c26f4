// SPDX-License-Identifier: GPL-2.0-or-later
// The steps of the implicit scheme.
#include <fmt/format.h>

#include <algorithm>

#include "base/fitted/constants.h"
#include "coupler/scheme/schemes.h"

namespace magfsi::coupler {

namespace {

// Speed [cells per step] of a fluid at rest: rounding errors of the largest speeds.
constexpr double rest_lattice_speed = 1e-9;

FixedPoint::Setting setting_of(const Session& session, const Grid& grid) {
    const double rest_m_s =
        rest_lattice_speed * grid.spacing_m / session.clock().step_s();
    return {*session.plan().coupling->iteration, rest_m_s, session.timeout_s()};
}

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

}  // namespace

ImplicitStructure::ImplicitStructure(Session& session, StructureSolver& solver,
                                     const Grid& grid, BodyMarkers markers)
    : StructureCoupling(session, solver, grid, std::move(markers)),
      fixed_point_(session.world(), setting_of(session, grid), force_->markers().size()),
      answer_(force_->markers().size()) {}

// What a checkpoint carries is what a repeated step starts from, except the iterations'.
void ImplicitStructure::keep_state() {
    solver_.keep();
    kept_m_ = step_.now_m;
    kept_.clear();
    for (const MarkerArray& array : StructureCoupling::carried())
        kept_.emplace_back(array.values.begin(), array.values.end());
    fixed_point_.begin_step(step_.fluid_velocity, step_.last_velocity);
}

void ImplicitStructure::guess_velocity() {
    const auto guess = fixed_point_.guess();
    force_->begin_step(guess);
    const bool no_slip = options_.immersed_boundary.forcing == Forcing::no_slip;
    const Line line =
        line_to(guess, step_.fluid_velocity, step_.last_velocity,
                no_slip ? fitted::drawn_back_no_slip : fitted::drawn_back_penalty);
    // If U were held at the value of the step's end the fluid would lead the body by half
    // a step, a negative added mass of kappa dt / 2 per marker, as large as the fluid
    // that the marker moves: light sheets would diverge.
    if (options_.sampled_velocity == SampledVelocity::linear)
        force_->let_change(line.start, line.end);
    else
        force_->hold(mean(line.start, line.end));
}

void ImplicitStructure::check_convergence() {
    again_ = fixed_point_.repeat(session_.clock().step(), answer_);
    if (!again_) return;
    solver_.go_back();
    step_.now_m = kept_m_;
    std::size_t number = 0;
    for (const MarkerArray& array : StructureCoupling::carried())
        std::ranges::copy(kept_[number++], array.values.begin());
}

void ImplicitStructure::accept_answer() {
    step_.last_velocity = step_.fluid_velocity;
    step_.fluid_velocity = answer_;
    // The enclosed fluid took the guess for the velocity at the step's end.
    std::ranges::copy(answer_, force_->enclosed().last_velocity().begin());
}

std::vector<MarkerArray> ImplicitStructure::carried() {
    std::vector<MarkerArray> all = StructureCoupling::carried();
    all.push_back({"last_velocity", flat(step_.last_velocity)});
    int number = 0;
    for (const auto& vector : fixed_point_.acceleration().vectors())
        all.push_back({fmt::format("iteration_{:03d}", number++), vector});
    return all;
}

std::vector<double> ImplicitStructure::carried_numbers() const {
    return fixed_point_.acceleration().numbers();
}

void ImplicitStructure::make_room(std::span<const double> numbers) {
    fixed_point_.acceleration().make_room(numbers, 3 * force_->markers().size());
}

void ImplicitFluid::begin_iterations() {
    iteration_ = 0;
    if (balance()) felt_ = boundary_->sampled_cells();
}

// After a move of the grid the cells of felt_ are others: their velocities are sampled
// again.
void ImplicitFluid::receive_markers() {
    receive({session_.clock().step(), iteration_});
    if (take_place() && !felt_.empty()) {
        boundary_->sample(batch_->before_m, batch_->volume_m3);
        felt_ = boundary_->sampled_cells();
    }
    if (iteration_ == 0) fluid_.keep();
}

void ImplicitFluid::check_convergence() {
    again_ = step_is_repeated(session_.world(), {session_.clock().step(), iteration_},
                              session_.timeout_s());
    if (!again_) return;
    fluid_.go_back();
    boundary_->fluid_has_changed();
    ++iteration_;
}

}  // namespace magfsi::coupler
