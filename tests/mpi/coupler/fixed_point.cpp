// SPDX-License-Identifier: GPL-2.0-or-later
// Both sides count the same iterations of each step, on any ranks; the measure is
// relative, and at rest absolute; a step that does not converge is named or counted.
#include "coupler/scheme/fixed_point.h"

#include <gtest/gtest.h>

#include <string>

#include "coupler/participants/errors.h"
#include "tests/mpi/coupler/split.h"
#include "tests/support/checks.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

constexpr int steps = 3;
constexpr std::size_t markers = 4;  // of each structure rank

FixedPoint::Setting setting() {
    FixedPoint::Setting s;
    s.iteration.acceleration = coupler::AccelerationMethod::aitken;
    s.iteration.relaxation = 1;
    s.iteration.velocity_tolerance = 1e-3;
    s.timeout_s = timeout_s;
    s.rest_m_s = 1e-9;
    return s;
}

// The fluid's part of H: it answers half of the guess and some of its own.
std::vector<Vec3> answer_to(std::span<const Vec3> guess, double own) {
    std::vector<Vec3> answer;
    for (const Vec3& g : guess)
        answer.push_back({0.5 * g[0] + own, 0.5 * g[1], 0.5 * g[2] - own});
    return answer;
}

// Iterations of each step from a guess of zero, as the rank's side counts them.
std::vector<int> counted(const World& world, const FixedPoint::Setting& wanted,
                         double own) {
    std::vector<int> all;
    if (world.self() == Role::fluid) {
        for (int step = 0; step < steps; ++step) {
            int iteration = 0;
            while (step_is_repeated(world, {step, iteration}, timeout_s)) ++iteration;
            all.push_back(iteration + 1);
        }
        return all;
    }
    FixedPoint point(world, wanted, markers);
    const std::vector<Vec3> zero(markers);
    for (int step = 0; step < steps; ++step) {
        point.begin_step(zero, zero);
        while (point.repeat(step, answer_to(point.guess(), own))) {
        }
        all.push_back(point.iteration() + 1);
    }
    EXPECT_EQ(point.record().steps, steps);
    EXPECT_EQ(point.record().most, all.front());
    EXPECT_EQ(point.record().iterations, steps * all.front());
    return all;
}

TEST(FixedPointOfAStep, both_sides_count_the_same_iterations) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        // Guesses 0 and 1 (times own) and their answers 1 and 1.5 show Aitken the
        // solution, 2.
        for (const double own : {1.0, 1e-6})
            EXPECT_EQ(counted(world, setting(), own), std::vector<int>(steps, 3)) << own;
    }
}

TEST(FixedPointOfAStep, at_rest_one_iteration_is_enough) {
    const World world(role_in(1), true);
    EXPECT_EQ(counted(world, setting(), 0), std::vector<int>(steps, 1));
    EXPECT_EQ(counted(world, setting(), 1e-15), std::vector<int>(steps, 1));
}

TEST(FixedPointOfAStep, goes_on_and_is_counted_if_the_scene_says_so) {
    const World world(role_in(1), true);
    auto wanted = setting();
    wanted.iteration.max_iterations = 2;
    wanted.iteration.on_no_convergence = coupler::OnNoConvergence::continue_;
    EXPECT_EQ(counted(world, wanted, 1), std::vector<int>(steps, 2));
}

TEST(FixedPointOfAStep, ends_with_what_was_reached) {
    const World world(role_in(1), true);
    if (world.self() == Role::fluid) {
        EXPECT_TRUE(step_is_repeated(world, {7, 0}, timeout_s));
        return;
    }
    auto wanted = setting();
    wanted.iteration.max_iterations = 2;
    FixedPoint point(world, wanted, markers);
    const std::vector<Vec3> zero(markers);
    point.begin_step(zero, zero);
    EXPECT_TRUE(point.repeat(7, answer_to(point.guess(), 1)));
    // Guess 1, answer 1.5: a third.
    test::expect_refusal<Diverged>(
        [&] { point.repeat(7, answer_to(point.guess(), 1)); },
        {"coupled step 7 has not converged: after 2 iterations the fluid velocity at the "
         "markers changes by 0.333 of itself"});
}

TEST(FixedPointOfAStep, first_guess_goes_on_as_the_step_before) {
    const World world(role_in(1), true);
    if (world.self() == Role::fluid) return;
    auto wanted = setting();
    const std::vector<Vec3> before(markers, Vec3{1, 2, 3}), now(markers, Vec3{2, 2, 1});
    FixedPoint linear(world, wanted, markers);
    linear.begin_step(now, before);
    EXPECT_EQ(linear.guess()[0], (Vec3{3, 2, -1}));
    wanted.iteration.initial_guess = coupler::InitialGuess::constant;
    FixedPoint constant(world, wanted, markers);
    constant.begin_step(now, before);
    EXPECT_EQ(constant.guess()[0], (Vec3{2, 2, 1}));
}

TEST(FixedPointOfAStep, a_message_of_another_iteration_is_refused) {
    const World world(role_in(1), true);
    if (world.self() == Role::structure) {
        ConvergenceSender sender(world, timeout_s);
        sender.send({5, 1}, true);
        return;
    }
    EXPECT_THROW(step_is_repeated(world, {5, 2}, timeout_s), PartnerLost);
}

}  // namespace
}  // namespace magfsi::coupler
