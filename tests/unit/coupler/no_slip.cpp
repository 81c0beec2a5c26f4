// SPDX-License-Identifier: GPL-2.0-or-later
// The memory of the slip, and what tells whether markers crowd.
#include "coupler/immersed_boundary/no_slip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupler/immersed_boundary/conditioning.h"
#include "coupler/immersed_boundary/layer_inertia.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Without the memory half of the slip would be left here.
TEST(SlipMemory, removes_a_steady_slip) {
    const std::vector<Vec3> body{{1, 0, 0}}, fluid{{0, 0, 0}}, even{{0, 0, 0}};
    SlipMemory memory(std::vector<Marker>(1), {0.25, 0.02, 0.02});
    double passed = 0;
    for (int step = 0; step < 400; ++step) {
        // A fluid of which half a felt slip is left, whatever it does.
        passed = 0.5 * (body[0][0] - memory.felt(fluid)[0][0]);
        memory.add(body, std::vector<Vec3>{{passed, 0, 0}}, even);
    }
    EXPECT_NEAR(passed, 1, 1e-12);
}

// A periodic plane of markers, `apart` cells from each other.
double condition_of_a_plane(double apart) {
    const Grid grid = cut_grid({12, 12, 8}, {true, true, true});
    std::vector<Vec3> points;
    const int n = static_cast<int>(std::lround(12 / apart));
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            points.push_back({(x + 0.3) * apart * grid.spacing_m,
                              (y + 0.3) * apart * grid.spacing_m, 4.2 * grid.spacing_m});
    return condition_number(grid, Kernel::three_point, points,
                            std::vector<double>(points.size(), 1));
}

// Of forces that alternate half a cell apart the kernel leaves next to nothing.
TEST(ConditionNumber, tells_crowded_markers) {
    EXPECT_LT(condition_of_a_plane(1.2), 20);
    EXPECT_GT(condition_of_a_plane(0.5), 1000);
}

// Two markers of one element in the plane of x and y, of which the second has no volume
// beyond its body.
class SheetOfTwo : public ::testing::Test {
  protected:
    SheetOfTwo() {
        Marker marker;
        marker.node = {0, 1, 2, 3, 4, 5, 6, 7};
        marker.beyond_m3 = beyond_m3;
        markers = {marker, marker};
        markers[1].beyond_m3 = 0;
        for (int m = 0; m < 2; ++m) {
            areas[static_cast<std::size_t>(m)].marker = m;
            areas[static_cast<std::size_t>(m)].first = {-1e-4, 1e-4};
            areas[static_cast<std::size_t>(m)].second = {-1e-4, 0, 1e-4};
        }
    }

    static constexpr double density = 1000, beyond_m3 = 2e-9;
    const std::vector<double> nodes{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                    0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    std::vector<Marker> markers;
    std::vector<MarkerArea> areas{2};
};

TEST_F(SheetOfTwo, gives_the_fluid_what_the_layer_gains_along_the_surface) {
    LayerInertia layer(markers, areas, density);
    const Vec3 before{0.3, 0, 0.1}, after{0.5, -0.2, 0.9}, impulse{1e-7, 2e-7, 3e-7};
    layer.start(std::vector<Vec3>(2, before), nodes.data());
    Vec3 sum{};
    for (int step = 0; step < 400; ++step) {
        layer.add(std::vector<Vec3>(2, impulse), std::vector<Vec3>(2, after),
                  nodes.data());
        for (std::size_t d = 0; d < 3; ++d) {
            sum[d] += layer.given()[0][d] - impulse[d];
            EXPECT_EQ(layer.given()[1][d], impulse[d]);
        }
    }
    EXPECT_NEAR(sum[0], density * beyond_m3 * 0.2, 1e-18);
    EXPECT_NEAR(sum[1], density * beyond_m3 * -0.2, 1e-18);
    EXPECT_NEAR(sum[2], 0, 1e-21);  // along the normal
}

// Of a velocity that grows evenly nothing is left behind.
TEST_F(SheetOfTwo, gives_it_without_lag) {
    LayerInertia layer(markers, areas, density);
    layer.start(std::vector<Vec3>(2), nodes.data());
    double sum = 0, velocity = 0;
    for (int step = 0; step < 400; ++step) {
        velocity += 0.01;
        layer.add(std::vector<Vec3>(2), std::vector<Vec3>(2, {velocity, 0, 0}),
                  nodes.data());
        sum += layer.given()[0][0];
    }
    EXPECT_NEAR(sum, density * beyond_m3 * velocity, 1e-17);
}

// A sheet that swims along its own plane and turns round takes back what it gave.
TEST_F(SheetOfTwo, gives_the_change_of_the_layers_momentum_however_it_turns) {
    LayerInertia layer(markers, areas, density);
    const double speed = 0.2;
    const auto turned = [](const double* v, double angle) {
        return Vec3{std::cos(angle) * v[0] + std::sin(angle) * v[2], v[1],
                    std::cos(angle) * v[2] - std::sin(angle) * v[0]};
    };
    const Vec3 before{speed, 0, speed};
    layer.start(std::vector<Vec3>(2, before), nodes.data());
    Vec3 sum{};
    for (int step = 1; step <= 1400; ++step) {
        const double angle = std::numbers::pi * std::min(step / 1000.0, 1.0);
        std::vector<double> position(nodes.size());
        for (std::size_t node = 0; node < nodes.size(); node += 3)
            std::ranges::copy(turned(&nodes[node], angle), &position[node]);
        layer.add(std::vector<Vec3>(2), std::vector<Vec3>(2, turned(&before[0], angle)),
                  position.data());
        sum += layer.given()[0];
    }
    EXPECT_NEAR(sum[0], density * beyond_m3 * -2 * speed, 1e-17);
    EXPECT_NEAR(sum[1], 0, 1e-17);
    EXPECT_NEAR(sum[2], 0, 1e-17);
}

// Two markers at one place that pull against each other.
TEST(SlipMemory, lets_go_of_what_the_fluid_does_not_feel) {
    const std::vector<Vec3> rest(2);
    SlipMemory memory(std::vector<Marker>(2), {0.25, 0.02, 0.02});
    memory.values()[0] = {1, 0, 0};
    memory.values()[1] = {-1, 0, 0};
    for (int step = 0; step < 2000; ++step) {
        const auto felt = memory.felt(rest);
        std::vector<Vec3> uneven(2);
        for (std::size_t m = 0; m < 2; ++m)
            uneven[m][0] = -fitted::no_slip_strength * felt[m][0];
        memory.add(rest, rest, uneven);
    }
    EXPECT_LT(std::abs(memory.values()[0][0]), 1e-9);
}

TEST(SlipMemory, leaks_more_in_the_core) {
    std::vector<Marker> markers(2);
    markers[1].core = true;
    SlipMemory memory(markers, {0.25, 0.02, 0.08});
    const std::vector<Vec3> rest(2), uneven{{1, 0, 0}, {1, 0, 0}};
    memory.add(rest, rest, uneven);
    EXPECT_DOUBLE_EQ(memory.values()[0][0], -0.02);
    EXPECT_DOUBLE_EQ(memory.values()[1][0], -0.08);
}

// Leak over gain times force (which goes with the step) stays where viscosity and speed
// do.
TEST(SlipRates, let_go_of_the_same_forces_at_any_step) {
    const auto rates = [](double step_s, double speed_m_s) {
        return slip_rates({1e-6, speed_m_s, 1e-4, step_s});
    };
    const auto of_gain = [&](double step_s, double speed_m_s) {
        const SlipRates found = rates(step_s, speed_m_s);
        return found.leak / found.gain;
    };
    for (const double speed_m_s : {1e-4, 2e-3})
        EXPECT_NEAR(of_gain(2e-4, speed_m_s), 2 * of_gain(4e-4, speed_m_s), 1e-12);
    for (const double step_s : {1e-3, 2e-3})  // relaxation times of 0.8 and 1.1
        EXPECT_NEAR(of_gain(step_s, 1e-5), 2 * of_gain(2 * step_s, 1e-5), 1e-12);
    EXPECT_EQ(rates(1e-7, 1e-4).leak, 0.25);
    // At the usual speed of 0.05 h a step, which is taken where none is given, and above.
    for (const double speed_m_s : {0.5, 0.0, 2.0}) {
        EXPECT_EQ(rates(1e-5, speed_m_s).gain, 0.25);
        EXPECT_EQ(rates(1e-5, speed_m_s).leak, 0.02);
    }
    EXPECT_NEAR(rates(2e-3, 1e-5).gain, 0.125, 1e-12);
}

}  // namespace
}  // namespace magfsi::coupler
