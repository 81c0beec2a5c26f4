// Eq. (13): what the fluid is given is what the body loses.
#include "coupler/immersed_boundary/penalty_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/coupler/random_markers.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

const PenaltyScale scale{0.75, 1000, 2e-5};

// Sums of about 100 terms against the largest.
constexpr double rounding = 1e-13;

Vec3 total(std::span<const Vec3> values) {
    Vec3 sum{};
    for (const Vec3& v : values)
        for (std::size_t d = 0; d < 3; ++d) sum[d] += v[d];
    return sum;
}

TEST(PenaltyForce, coefficient_is_strength_times_two_rho_volume_over_step) {
    Marker marker;
    marker.volume_m3 = 3e-12;
    EXPECT_DOUBLE_EQ(scale.coefficient(marker), 0.75 * 2 * 1000 * 3e-12 / 2e-5);
}

TEST(PenaltyForce, one_marker_by_hand) {
    Marker marker;
    marker.weight = {1, 0, 0, 0, 0, 0, 0, 0};
    marker.volume_m3 = 1e-12;
    PenaltyForce penalty({marker}, scale, {});
    penalty.begin_step(std::vector<Vec3>{{0.1, 0, -0.2}});
    const double velocity[] = {0.4, 0, 0.3};
    double force[3] = {};
    penalty.apply(velocity, force, 5e-6);
    const double kappa = 7.5e-5;  // kg/s
    // Drag opposes the slip of the body through the fluid: V - U = (0.3, 0, 0.5) m/s.
    EXPECT_NEAR(force[0], -kappa * 0.3, rounding * kappa);
    EXPECT_EQ(force[1], 0);
    EXPECT_NEAR(force[2], -kappa * 0.5, rounding * kappa);
    EXPECT_NEAR(penalty.impulse()[0][0], kappa * 0.3 * 5e-6, rounding * kappa * 5e-6);
    EXPECT_NEAR(penalty.impulse()[0][2], kappa * 0.5 * 5e-6, rounding * kappa * 5e-6);
}

// Constant forces on a marker at rest in a fluid that gathers speed: each of the uneven
// substeps has the velocity of its middle, and together they have the mean of the ends.
TEST(PenaltyForce, fluid_velocity_that_changes_within_the_step) {
    Marker marker;
    marker.weight = {1, 0, 0, 0, 0, 0, 0, 0};
    marker.volume_m3 = 1e-12;
    PenaltyForce penalty({marker}, scale, {});
    penalty.begin_step(std::vector<Vec3>{{9, 9, 9}});
    penalty.let_change(std::vector<Vec3>{{0.1, 0, 0}}, std::vector<Vec3>{{0.5, 0, -2}});
    const double at_rest[3] = {};
    double force[3] = {};
    const double kappa = 7.5e-5;          // kg/s
    penalty.apply(at_rest, force, 5e-6);  // of 2e-5
    EXPECT_NEAR(force[0], kappa * (0.1 + 0.4 * 0.125), rounding * kappa);
    penalty.apply(at_rest, force, 1e-5);
    penalty.apply(at_rest, force, 5e-6);
    EXPECT_NEAR(penalty.impulse()[0][0], -kappa * 0.3 * 2e-5, rounding * kappa * 2e-5);
    EXPECT_NEAR(penalty.impulse()[0][2], kappa * 1.0 * 2e-5, rounding * kappa * 2e-5);
    // The next step is held again unless told otherwise.
    penalty.begin_step(std::vector<Vec3>{{0.2, 0, 0}});
    penalty.apply(at_rest, force, 1e-5);
    penalty.apply(at_rest, force, 1e-5);
    EXPECT_NEAR(penalty.impulse()[0][0], -kappa * 0.2 * 2e-5, rounding * kappa * 2e-5);
}

// Newton's third law over a coupled step of uneven substeps: the impulse of the nodes'
// forces and the markers' impulses cancel, also marker by marker through the shape
// functions.
TEST(PenaltyForce, impulse_given_is_the_impulse_lost) {
    Random random(31);
    PenaltyForce penalty(random_markers(random, 30), scale, {});
    penalty.begin_step(random.vectors(30, 0.5));
    Vec3 lost{};
    for (const double duration_s : {1e-6, 4e-6, 2e-6, 3e-6}) {
        const auto velocity = random_nodal(random);
        std::vector<double> force(velocity.size());
        penalty.apply(velocity.data(), force.data(), duration_s);
        for (std::size_t i = 0; i < force.size(); ++i)
            lost[i % 3] += force[i] * duration_s;
    }
    const Vec3 given = total(penalty.impulse());
    double largest = 0;
    for (const Vec3& j : penalty.impulse()) largest = std::max(largest, std::abs(j[0]));
    ASSERT_GT(largest, 0);
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_NEAR(given[d], -lost[d], rounding * 30 * largest) << "axis " << d;
    }
}

TEST(PenaltyForce, no_slip_no_force) {
    Random random(32);
    const auto markers = random_markers(random, 20);
    PenaltyForce penalty(markers, scale, {});
    const auto velocity = random_nodal(random);
    std::vector<Vec3> same;
    for (const Marker& m : markers) same.push_back(at_marker(m, velocity.data()));
    penalty.begin_step(same);
    std::vector<double> force(velocity.size());
    penalty.apply(velocity.data(), force.data(), 1e-6);
    for (const double f : force) EXPECT_EQ(f, 0);
    for (const Vec3& j : penalty.impulse()) EXPECT_EQ(j, Vec3{});
}

TEST(PenaltyForce, a_new_step_starts_from_zero_impulse) {
    Random random(33);
    PenaltyForce penalty(random_markers(random, 5), scale, {});
    penalty.begin_step(random.vectors(5, 0.5));
    const auto velocity = random_nodal(random);
    std::vector<double> force(velocity.size());
    penalty.apply(velocity.data(), force.data(), 1e-6);
    ASSERT_NE(total(penalty.impulse()), Vec3{});
    const auto next = random.vectors(5, 0.5);
    penalty.begin_step(next);
    for (std::size_t m = 0; m < 5; ++m) {
        EXPECT_EQ(penalty.impulse()[m], Vec3{});
        EXPECT_EQ(penalty.fluid_velocity()[m], next[m]);
    }
}

// At strength 1 half of the impulse at the step's start and Guo's half-force bring a
// fluid of the marker's volume to the marker's velocity: kappa dt / (rho dV) = 2.
TEST(PenaltyForce, strength_one_gives_twice_the_momentum_of_the_slip) {
    Marker marker;
    marker.weight = {1, 0, 0, 0, 0, 0, 0, 0};
    marker.volume_m3 = 1e-12;
    PenaltyForce penalty({marker}, {1, 1000, 2e-5}, {});
    penalty.begin_step(std::vector<Vec3>{{0, 0, 0}});
    const double velocity[] = {1, 0, 0};
    double force[3] = {};
    penalty.apply(velocity, force, 2e-5);
    EXPECT_NEAR(penalty.impulse()[0][0], 2 * 1000 * 1e-12, 1e-15 * 2e-9);
}

}  // namespace
}  // namespace magfsi::coupler
