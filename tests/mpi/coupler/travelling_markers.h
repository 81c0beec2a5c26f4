// A cloud of markers whose path and impulses every rank knows, and what a fluid on one
// rank answers to it.
#pragma once

#include <cmath>
#include <vector>

#include "coupler/immersed_boundary/spreading.h"
#include "tests/mpi/coupler/array_fluid.h"

namespace magfsi::coupler::testing {

constexpr std::int64_t coupled_steps = 40;
constexpr Kernel kernel = Kernel::three_point;

// Periodic along x and y, cut along y.
inline Grid channel(int fluid_ranks) {
    return cut_grid({16, 30, 10}, {true, true, false}, {1, fluid_ranks, 1});
}

// Three cells along y, near the side y = 0, and from wall to wall. In 40 steps it travels
// 9 cells along +x and -y, through both periodic sides and from the first rank to the
// last.
class TravellingMarkers {
  public:
    static constexpr std::size_t count = 60;

    explicit TravellingMarkers(double spacing_m) : h_(spacing_m) {
        Random random(51);
        for (std::size_t m = 0; m < count; ++m) {
            start_.push_back(
                {random.between(9, 16), random.between(4, 7), random.between(1, 9)});
        }
    }

    // Up to 0.24 cells a step along an axis.
    std::vector<Vec3> positions(std::int64_t step) const {
        std::vector<Vec3> all;
        const double t = static_cast<double>(step);
        for (const Vec3& s : start_) {
            const double wave =
                0.9 * std::sin(0.2 * t + s[0]) * (s[2] - 1) * (9 - s[2]) / 16;
            all.push_back(
                {(s[0] + 0.23 * t) * h_, (s[1] - 0.24 * t) * h_, (s[2] + wave) * h_});
        }
        return all;
    }

    // [N s], enough to change the cells' velocities by about 0.01 m/s.
    std::vector<Vec3> impulses(std::int64_t step) const {
        std::vector<Vec3> all;
        for (std::size_t m = 0; m < count; ++m) {
            const double phase = 0.3 * static_cast<double>(step) + static_cast<double>(m);
            all.push_back({1e-9 * std::sin(phase), -1e-9, 2e-9 * std::cos(phase)});
        }
        return all;
    }

  private:
    double h_;
    std::vector<Vec3> start_;  // in cells
};

// The velocities at all markers after each coupled step, the first positions' before
// them, from a fluid on a single box.
inline std::vector<std::vector<Vec3>> velocities_on_one_rank() {
    const Grid grid = channel(1);
    const TravellingMarkers markers(grid.spacing_m);
    ArrayFluid fluid(grid, 0);
    FluidSide side(fluid, grid.owned_by_rank[0], kernel, ArrayFluid::step_s);
    std::vector<std::vector<Vec3>> all;
    const auto sample = [&](std::int64_t step) {
        const auto u = side.sample(markers.positions(step));
        all.emplace_back(u.begin(), u.end());
    };
    sample(0);
    for (std::int64_t step = 0; step < coupled_steps; ++step) {
        side.spread(markers.positions(step), markers.impulses(step));
        fluid.advance();
        sample(step + 1);
    }
    return all;
}

}  // namespace magfsi::coupler::testing
