// SPDX-License-Identifier: GPL-2.0-or-later
// The forces between markers and the fluid: what one is given the other loses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupler/immersed_boundary/direct_forcing.h"
#include "coupler/immersed_boundary/fluid_side.h"
#include "tests/mpi/coupler/array_fluid.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

constexpr std::size_t nodes = 40;

// Trilinear shape functions at a random point, on eight different nodes.
std::vector<Marker> random_markers(Random& random, std::size_t count) {
    std::vector<Marker> markers(count);
    for (Marker& marker : markers) {
        const Vec3 xi = random.vector(1);
        const int first = static_cast<int>(random.between(0, nodes));
        for (std::size_t a = 0; a < 8; ++a) {
            marker.node[a] = (first + 5 * static_cast<int>(a)) % static_cast<int>(nodes);
            marker.weight[a] = (1 + (a & 1 ? xi[0] : -xi[0])) *
                               (1 + (a & 2 ? xi[1] : -xi[1])) *
                               (1 + (a & 4 ? xi[2] : -xi[2])) / 8;
        }
        marker.volume_m3 = random.between(1e-12, 1e-11);
    }
    return markers;
}

std::vector<double> random_nodal(Random& random) {
    std::vector<double> values(3 * nodes);
    for (double& v : values) v = random.between(-0.5, 0.5);
    return values;
}

// A marker's force reaches its nodes by the transpose of what brings their motion to it.
TEST(MarkerWeights, the_two_ways_are_transposed) {
    Random random(21);
    for (const Marker& marker : random_markers(random, 100)) {
        const auto velocity = random_nodal(random);
        const Vec3 force = random.vector(1);
        const Vec3 at = at_marker(marker, velocity.data());
        std::vector<double> nodal(velocity.size());
        to_nodes(marker, force, nodal.data());
        const double at_the_marker =
            force[0] * at[0] + force[1] * at[1] + force[2] * at[2];
        const double at_the_nodes =
            std::inner_product(nodal.begin(), nodal.end(), velocity.begin(), 0.0);
        // 24 products of order 0.1.
        EXPECT_NEAR(at_the_marker, at_the_nodes, 1e-15);
    }
}

TEST(MarkerWeights, forces_add_to_what_the_nodes_hold) {
    Random random(22);
    const Marker marker = random_markers(random, 1)[0];
    std::vector<double> nodal(3 * nodes, 5.0);
    to_nodes(marker, {1, 0, -2}, nodal.data());
    Vec3 sum{};
    for (std::size_t i = 0; i < nodal.size(); ++i) sum[i % 3] += nodal[i] - 5.0;
    // The weights add up to one; differences to 5 are rounded to 1e-15 each.
    EXPECT_NEAR(sum[0], 1, 1e-14);
    EXPECT_EQ(sum[1], 0);
    EXPECT_NEAR(sum[2], -2, 1e-14);
}

// Eq. (13): what the fluid is given is what the body loses.
const PenaltyScale scale{0.75, 1000, 2e-5};

// Sums of about 100 terms against the largest.
constexpr double rounding = 1e-13;

Vec3 total(std::span<const Vec3> values) {
    Vec3 sum{};
    for (const Vec3& v : values) sum += v;
    return sum;
}

TEST(PenaltyForce, coefficient_is_strength_times_two_rho_volume_over_step) {
    Marker marker;
    marker.volume_m3 = 3e-12;
    EXPECT_DOUBLE_EQ(scale.drag_coefficient_kg_s(marker.volume_m3),
                     0.75 * 2 * 1000 * 3e-12 / 2e-5);
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

// Markers of which one to six that follow each other lie in the same element.
std::vector<Marker> markers_in_elements(Random& random) {
    std::vector<Marker> all;
    for (const std::size_t count : {1, 1, 2, 6, 3, 3, 4, 1, 5}) {
        std::vector<Marker> element = random_markers(random, count);
        for (Marker& marker : element) {
            marker.node = element[0].node;
            marker.displaced_m3 = random.between(1e-12, 1e-11);
            all.push_back(marker);
        }
    }
    return all;
}

// The kernels neither change the order of the sums nor fuse products with them: equal
// runs must give equal files on all machines.
TEST(PenaltyForce, equals_a_plain_loop_over_the_markers_in_every_instruction_set) {
    for (const InstructionSet set : available_instruction_sets()) {
        Random random(34);
        const auto markers = markers_in_elements(random);
        PenaltyForce penalty(markers, scale, {0, 0, -9.81}, set);
        const auto fluid = random.vectors(markers.size(), 0.5);
        penalty.begin_step(fluid);
        std::vector<Vec3> impulse(markers.size());
        for (const double duration_s : {1e-6, 4e-6, 3e-6}) {
            const auto velocity = random_nodal(random);
            auto force = random_nodal(random), plain = force;
            penalty.apply(velocity.data(), force.data(), duration_s);
            for (std::size_t m = 0; m < markers.size(); ++m) {
                const Vec3 given = scale.drag_coefficient_kg_s(markers[m].volume_m3) *
                                   (at_marker(markers[m], velocity.data()) - fluid[m]);
                impulse[m] += given * duration_s;
                to_nodes(markers[m], penalty.enclosed().force()[m] - given, plain.data());
            }
            EXPECT_EQ(force, plain) << name(set);
        }
        EXPECT_TRUE(std::ranges::equal(penalty.impulse(), impulse)) << name(set);
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

// The force that takes the enclosed fluid's inertia away again and gives buoyancy.
constexpr double step_s = 1e-4, density = 1000, volume = 2e-9;

std::vector<Marker> two_markers() {
    Marker marker;
    marker.displaced_m3 = volume;
    return {marker, marker};
}

TEST(EnclosedFluid, in_still_fluid_is_buoyancy) {
    EnclosedFluid enclosed(two_markers(), {density, step_s, {0, 0, -9.81}});
    enclosed.start(std::vector<Vec3>(2, Vec3{0.3, 0, 0}));
    for (int step = 0; step < 3; ++step) {
        enclosed.begin_step(std::vector<Vec3>(2, Vec3{0.3, 0, 0}));  // steady motion
        for (const Vec3& force : enclosed.force()) {
            EXPECT_EQ(force[0], 0);
            EXPECT_DOUBLE_EQ(force[2], density * volume * 9.81);
        }
    }
}

TEST(EnclosedFluid, in_accelerated_fluid_is_mass_times_acceleration) {
    EnclosedFluid enclosed(two_markers(), {density, step_s, {}});
    constexpr double acceleration = 5;
    for (int step = 0; step < 200; ++step) {
        const Vec3 u{acceleration * step * step_s, 0, 0};
        enclosed.begin_step(std::vector<Vec3>{u, Vec3{}});
    }
    // What is left of the start after 199 steps of 0.9: 1e-9.
    const double expected = density * volume * acceleration;
    EXPECT_NEAR(enclosed.force()[0][0] / expected, 1, 1e-8);
    EXPECT_EQ(enclosed.force()[1][0], 0);
}

TEST(EnclosedFluid, of_a_light_body_follows_without_lag_an_acceleration_that_grows) {
    auto markers = two_markers();
    for (Marker& marker : markers)
        marker.enclosed_follow = enclosed_follow_of(0.1, Kernel::three_point);
    EnclosedFluid enclosed(markers, {density, step_s, {}});
    constexpr double jerk = 300;
    double before = 0, now = 0;
    for (int step = 0; step < 400; ++step) {
        const double t = step * step_s, u = 0.5 * jerk * t * t;
        enclosed.begin_step(std::vector<Vec3>{Vec3{u, 0, 0}, Vec3{}});
        now = (u - before) / step_s;
        before = u;
    }
    // Of the start 400 times 0.84^400 is left; the mean alone would lag by two steps of
    // them.
    EXPECT_NEAR(enclosed.force()[0][0] / (density * volume * now), 1, 1e-8);
}

TEST(EnclosedFluid, follows_as_fast_as_density_and_kernel_bear) {
    EXPECT_EQ(enclosed_follow_of(0.01, Kernel::three_point).part, 0.1);
    EXPECT_EQ(enclosed_follow_of(0.1, Kernel::two_point).part, 0.15);
    EXPECT_TRUE(enclosed_follow_of(0.1, Kernel::two_point).without_lag);
    EXPECT_FALSE(enclosed_follow_of(1.1, Kernel::three_point).without_lag);
}

// The impulse of a whole change of velocity is that of the enclosed mass, however it is
// smoothed.
TEST(EnclosedFluid, keeps_the_momentum_of_a_jump) {
    EnclosedFluid enclosed(two_markers(), {density, step_s, {}});
    enclosed.begin_step(std::vector<Vec3>(2));
    double impulse = 0;
    for (int step = 0; step < 300; ++step) {
        enclosed.begin_step(std::vector<Vec3>(2, Vec3{0, 0.2, 0}));
        impulse += enclosed.force()[0][1] * step_s;
    }
    EXPECT_NEAR(impulse / (density * volume * 0.2), 1, 1e-12);  // 0.9^300 and rounding
}

}  // namespace
}  // namespace magfsi::coupler
