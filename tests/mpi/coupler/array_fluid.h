// The plainest fluid on a grid: each cell is a free mass that its force accelerates. What
// it lacks in physics it has in clarity: every velocity that the exchange should deliver
// can be computed on one rank.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
          box_(grid.owned_by_rank[static_cast<std::size_t>(rank)]),
          velocity_(grid),
          force_(grid) {
        for (int z = box_.lo[2]; z < box_.hi[2]; ++z)
            for (int y = box_.lo[1]; y < box_.hi[1]; ++y)
                for (int x = box_.lo[0]; x < box_.hi[0]; ++x) start(x, y, z);
    }

    const Grid& grid() const override { return grid_; }

    void velocity(std::span<const GridRow> rows, std::span<double> out) override {
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

}  // namespace magfsi::coupler::testing
