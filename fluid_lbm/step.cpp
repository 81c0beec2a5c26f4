// SPDX-License-Identifier: GPL-2.0-or-later
// The time step of a fluid, and its repetition with other forces.
#include "fluid_lbm/state.h"

namespace magfsi::fluid {

namespace {

using State = Fluid::State;

// Collides and streams the rows of the boxes, and keeps the first invalid cell of the
// earliest step that found one.
void sweep_boxes(State& s, std::span<const RowBox> boxes) {
    for (const RowBox& box : boxes) {
        const auto found =
            sweep(s.view(), s.forces ? &*s.forces : nullptr, box, s.needed().x_ends);
        if (!found) continue;
        const bool first =
            !s.invalid || (s.invalid_step == s.steps_done && found->before(*s.invalid));
        if (!first) continue;
        s.invalid = *found;
        s.invalid_step = s.steps_done;
    }
}

// Sweeps all rows and exchanges populations with the neighbours. The rows at cut sides
// come first, so that their populations travel while the others are computed.
void sweep_and_exchange(State& s) {
    const Exchange exchange =
        s.arrangement == Arrangement::natural ? Exchange::fill : Exchange::give_back;
    // In a step that is repeated by rows, the other rows stand at the step's end already;
    // what was sent for them is sent again unchanged.
    const bool by_rows = s.again && s.kept->by_rows();
    const std::span<const RowBox> inner =
        by_rows ? std::span<const RowBox>() : s.needed().inner;
    const std::size_t half = inner.size() / 2;
    sweep_boxes(s, by_rows ? s.kept->rows() : s.needed().at_cuts);
    s.halo.start(exchange);
    sweep_boxes(s, inner.first(half));
    s.halo.advance();
    sweep_boxes(s, inner.subspan(half));
    s.halo.finish();
    s.again = false;
}

}  // namespace

void Fluid::step() {
    State& s = *state_;
    if (s.kept) {
        s.need_forces({});
        s.kept->note_rows(s.view(), s.forces->claimed_rows());
    }
    for (const auto& side : s.side_effects)
        side->before_sweep(s.populations, s.arrangement);
    sweep_and_exchange(s);
    s.arrangement = arrangement_after(s.steps_done + 1);
    if (s.obstacles) s.obstacles->note_sent(s.populations, s.arrangement);
    // Sides act at the middle of the step, when a population crosses them.
    for (const auto& side : s.side_effects)
        side->after_exchange(s.populations, s.layout,
                             static_cast<double>(s.steps_done) + 0.5);
    if (s.obstacles) s.obstacles->bounce(s.populations, s.arrangement);
    s.reset_solid_cells();  // before end_step(): an outlet may read solid cells
    for (const auto& side : s.side_effects) side->end_step(s.populations, s.arrangement);
    if (s.forces) s.forces->clear();
    ++s.steps_done;
}

void Fluid::keep() {
    if (!state_->kept) state_->kept.emplace(sweep_is_all(state_->config));
    state_->kept->keep(state_->view());
}

void Fluid::go_back() {
    State& s = *state_;
    set_steps_done(s.steps_done - 1);
    s.kept->put_back(s.view());
    s.again = true;
    // A fault that the undone step has found is dropped, unless it lies in a row that is
    // not swept again.
    const bool undone =
        s.invalid && (!s.kept->by_rows() || s.kept->has(s.invalid->y, s.invalid->z));
    if (undone) s.invalid.reset();
}

void Fluid::set_steps_done(std::int64_t steps) {
    state_->steps_done = steps;
    state_->arrangement = arrangement_after(steps);
}

}  // namespace magfsi::fluid
