// SPDX-License-Identifier: GPL-2.0-or-later
// The two forcings on a structure rank: their tasks, their state, and the coefficients
// that follow from the fluid's answer.
#include "coupler/scheme/forcing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/fitted/constants.h"

namespace magfsi::coupler {
namespace {

// One element in the plane of x and y that moves at a given velocity.
class MovingElement final : public StructureSolver {
  public:
    const double* positions() const override { return x_.data(); }
    const double* velocities() const override { return v_.data(); }
    void renew_ghost_velocities() override {}
    void attach_fluid_force(NodalForce) override {}
    void advance() override {}
    void check_finite(std::int64_t) const override {}
    void keep() override {}
    void go_back() override {}

    void move_at(const Vec3& velocity) {
        for (std::size_t i = 0; i < v_.size(); ++i) v_[i] = velocity[i % 3];
    }

  private:
    std::vector<double> x_{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                           0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    std::vector<double> v_ = std::vector<double>(24);
};

constexpr double density = 1000, step_s = 1e-4, volume = 2e-9;
const PenaltyScale scale{1, density, step_s};
const Vec3 gravity{0, 0, -9.81};

// Two markers, each the middle of the element.
class TwoMarkers : public ::testing::Test {
  protected:
    TwoMarkers() {
        Marker marker;
        marker.node = {0, 1, 2, 3, 4, 5, 6, 7};
        marker.weight.fill(0.125);
        marker.volume_m3 = volume;
        marker.displaced_m3 = volume;
        marker.beyond_m3 = volume;
        markers = {marker, marker};
        for (int m = 0; m < 2; ++m) areas.push_back({m, {-1e-4, 1e-4}, {-1e-4, 0, 1e-4}});
        step.before_m = step.now_m = std::vector<Vec3>(2);
        step.last_velocity = step.fluid_velocity = {{0.1, 0, 0}, {0, 0.2, -0.1}};
    }

    NoSlipForcing no_slip(bool carries_layers = true) const {
        return {markers,
                scale,
                gravity,
                step,
                {{0.25, 0.02, 0.08}, {1, 0, 0}, carries_layers, areas}};
    }

    // Gives the answer of a fluid in which q is half of U and the row sums are these.
    void answer(NoSlipForcing& force, double row_sum) const {
        force.answer()->row_sum.assign(2, row_sum);
        force.answer()->passed.clear();
        for (const Vec3& u : step.fluid_velocity)
            force.answer()->passed.push_back({u[0] / 2, u[1] / 2, u[2] / 2});
    }

    // One coupled step at a velocity of the body, in a single substep.
    void take_step(PenaltyForcing& force, TaskList& tasks, const Vec3& velocity) {
        solver.move_at(velocity);
        force.begin_step(step.fluid_velocity);
        std::vector<double> nodal(24);
        force.apply(solver.velocities(), nodal.data(), step_s);
        for (Vec3& x : step.now_m)
            for (std::size_t d = 0; d < 3; ++d) x[d] += velocity[d] * step_s;
        tasks.run();
        step.before_m = step.now_m;
    }

    MovingElement solver;
    MarkerStep step{solver, step_s};
    std::vector<Marker> markers;
    std::vector<MarkerArea> areas;
};

TEST_F(TwoMarkers, penalty_has_no_task_and_asks_for_no_answer) {
    PenaltyForcing force(markers, scale, gravity, step);
    TaskList tasks;
    force.add_to_advance(tasks);
    force.add_to_answer(tasks);
    EXPECT_EQ(tasks.size(), 0u);
    EXPECT_EQ(force.answer(), nullptr);
    EXPECT_TRUE(force.volumes_m3().empty());
    EXPECT_EQ(force.carried().size(), 3u);
}

TEST_F(TwoMarkers, no_slip_has_a_task_for_layers_only_if_there_are_any) {
    for (const bool layers : {false, true}) {
        NoSlipForcing force = no_slip(layers);
        TaskList tasks;
        force.add_to_advance(tasks);
        force.add_to_answer(tasks);
        EXPECT_EQ(tasks.names(),
                  layers ? "carry layers, remember slip" : "remember slip");
        EXPECT_EQ(force.carried().size(), layers ? 7u : 4u);
    }
}

// The coefficient is divided by the row sum, whatever it was before, and bounded.
TEST_F(TwoMarkers, no_slip_divides_its_coefficient_by_the_row_sums) {
    NoSlipForcing force = no_slip(false);
    TaskList tasks;
    force.add_to_answer(tasks);
    answer(force, 0.5);
    force.start(true);
    const auto coefficient = [&] {
        solver.move_at({1, 0, 0});
        force.begin_step(std::vector<Vec3>(2));
        std::vector<double> nodal(24);
        // The memory p is added to the slip, as U - p stands for U.
        const auto memory = force.carried().back().values;
        const double slip = 1 + memory[0];
        force.apply(solver.velocities(), nodal.data(), step_s);
        return force.impulse()[0][0] / (slip * step_s);
    };
    const double own = fitted::no_slip_strength * 2 * density * volume / step_s;
    EXPECT_DOUBLE_EQ(coefficient(), own / 0.5);
    for (const double row_sum : {0.8, 0.25}) {
        answer(force, row_sum);
        tasks.run();
        EXPECT_DOUBLE_EQ(coefficient(), own / std::max(row_sum, fitted::least_row_sum));
    }
    answer(force, 0);
    tasks.run();
    EXPECT_DOUBLE_EQ(coefficient(), own / fitted::least_row_sum);
}

// What is carried from step to step is all that a step depends on: the implicit scheme
// repeats a step from it, and a restart goes on from it.
TEST_F(TwoMarkers, carried_arrays_are_the_whole_state) {
    NoSlipForcing force = no_slip();
    TaskList advance;
    force.add_to_advance(advance);
    answer(force, 0.6);
    force.start(true);
    take_step(force, advance, {0.3, 0.1, 0});
    const auto first_m = step.now_m;
    std::vector<std::vector<double>> kept;
    for (const MarkerArray& array : force.carried())
        kept.emplace_back(array.values.begin(), array.values.end());
    const auto results = [&](const Vec3& velocity) {
        step.before_m = step.now_m = first_m;
        take_step(force, advance, velocity);
        std::vector<Vec3> all(force.given().begin(), force.given().end());
        const auto enclosed = force.enclosed().force();
        all.insert(all.end(), enclosed.begin(), enclosed.end());
        return all;
    };
    step.fluid_velocity = {{0.4, 0, 0.3}, {-0.2, 0.1, 0}};
    const auto once = results({0.5, 0.2, 0.1});
    std::size_t number = 0;
    for (const MarkerArray& array : force.carried())
        std::ranges::copy(kept[number++], array.values.begin());
    EXPECT_EQ(results({0.5, 0.2, 0.1}), once);
    EXPECT_NE(results({0.5, 0.2, 0.1}), once);  // from the step's end it differs
}

}  // namespace
}  // namespace magfsi::coupler
