// SPDX-License-Identifier: GPL-2.0-or-later
// The plainest fluid on a grid: each cell is a free mass that its force accelerates. What
// it lacks in physics it has in clarity: every velocity that the exchange should deliver
// can be computed on one rank.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "coupler/immersed_boundary/fluid_side.h"
#include "coupler/immersed_boundary/grid.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler::testing {

class ArrayFluid final : public GridFluid {
  public:
    static constexpr double step_s = 2e-5;
    static constexpr double density_kg_m3 = 1000;

    // Starts from an analytic field of order 1 m/s in the cells of this rank.
    ArrayFluid(const Grid& grid, int rank)
        : grid_(grid),
          box_(grid.owned_by_rank[static_cast<std::size_t>(rank)].front()),
          velocity_(grid),
          force_(grid) {
        for (int z = box_.lo[2]; z < box_.hi[2]; ++z)
            for (int y = box_.lo[1]; y < box_.hi[1]; ++y)
                for (int x = box_.lo[0]; x < box_.hi[0]; ++x) start(x, y, z);
    }

    const Grid& grid() const override { return grid_; }

    void velocity(std::span<const GridRow> rows, std::span<double> out,
                  std::span<double> relative_density) override {
        std::ranges::fill(relative_density, 1.0);
        expect_own(rows);
        const auto values = velocity_.read(rows);
        ASSERT_EQ(values.size(), out.size());
        std::copy(values.begin(), values.end(), out.begin());
    }

    void set_force(std::span<const GridRow> rows,
                   std::span<const double> density) override {
        expect_own(rows);
        force_ = CellField(grid_);
        force_.add(rows, density);
    }

    void advance() override {
        for (std::size_t i = 0; i < velocity_.values().size(); ++i) {
            velocity_.values()[i] += step_s / density_kg_m3 * force_.values()[i];
        }
    }

    // Of the coming step, over the cells of this rank [N].
    Vec3 total_force() const {
        Vec3 sum{};
        for (std::size_t i = 0; i < force_.values().size(); ++i) {
            sum[i % 3] += force_.values()[i] * std::pow(grid_.spacing_m, 3);
        }
        return sum;
    }

  private:
    void start(int x, int y, int z) {
        double* u = &velocity_.values()[velocity_.index(x, y, z)];
        const auto wave = [](int i, int n) {
            return 2 * std::numbers::pi * (i + 0.5) / n;
        };
        u[0] = std::sin(wave(y, grid_.cells[1])) + 0.3;
        u[1] = std::cos(wave(x, grid_.cells[0])) * std::sin(wave(z, grid_.cells[2]));
        u[2] = 0.1 * z - 0.2 * std::sin(3 * wave(x, grid_.cells[0]));
    }

    void expect_own(std::span<const GridRow> rows) const {
        for (const GridRow& r : rows) {
            EXPECT_TRUE(r.x_begin >= box_.lo[0] && r.x_end <= box_.hi[0]) << r.x_begin;
            EXPECT_TRUE(r.y >= box_.lo[1] && r.y < box_.hi[1]) << r.y;
            EXPECT_TRUE(r.z >= box_.lo[2] && r.z < box_.hi[2]) << r.z;
        }
    }

    Grid grid_;
    CellBox box_;
    CellField velocity_, force_;
};

// A cloud of markers whose path and impulses every rank knows, and what a fluid on one
// rank answers to it.
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
