// SPDX-License-Identifier: GPL-2.0-or-later
// A patch that stays and holds the whole way of what a stream carries: a band that spans
// the box along the stream, periodic there. What is wrong in it is the fine grid's error
// and that of its sides alone, for no part of the way is on coarse cells.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "tests/support/carried_vortex.h"

namespace magfsi::fluid {
namespace {

// Taylor's vortex (1918), an exact solution of the Navier-Stokes equations without
// circulation, which vanishes as exp(-r^2): u = U r / s exp((1 - r^2 / s^2) / 2), s^2
// growing by 2 nu t, U falling with s^-3.
struct RoundVortex {
    int cells = 64;
    double relaxation_time = 0.503, speed = 0.015, stream = 0.05, radius = 8;
    Vec3 middle{32, 32, 0};

    double viscosity() const { return (relaxation_time - 0.5) / 3; }
    Vec3 swirl(const Vec3& at, double time) const {
        const double s2 = radius * radius + 2 * viscosity() * time;
        const auto [x, y] = away(at, time);
        const double turn = speed * std::pow(radius / std::sqrt(s2), 3) / std::sqrt(s2) *
                            std::exp((1 - (x * x + y * y) / s2) / 2);
        return {-turn * y, turn * x, 0};
    }
    Vec3 velocity(const Vec3& at, double time) const {
        const Vec3 u = swirl(at, time);
        return {u[0] + stream, u[1], u[2]};
    }
    double pressure(const Vec3& at, double time) const {  // while it is new
        const auto [x, y] = away(at, time);
        return -speed * speed / 2 * std::exp(1 - (x * x + y * y) / (radius * radius));
    }
    FluidConfig config() const { return config_of(*this); }

  private:
    // From its middle, or the image of that which is nearest.
    std::array<double, 2> away(const Vec3& at, double time) const {
        std::array<double, 2> from{at[0] - middle[0] - stream * time, at[1] - middle[1]};
        for (double& d : from) d -= cells * std::round(d / cells);
        return from;
    }
};

// Sums of squares of the velocity's error and of the swirl.
struct Squares {
    double error = 0, swirl = 0;
    double relative() const { return std::sqrt(error / swirl); }
};

// Within y of `band` or beyond [coarse cells], in cells that count from `first`.
Squares squares(const RoundVortex& vortex, const Fluid& fluid, bool within,
                const std::array<double, 2>& band, double time, int first = 0) {
    const double h = fluid.config().spacing_m;
    Squares sums;
    const CellBox own = fluid.owned();
    for (int y = own.lo[1]; y < own.hi[1]; ++y) {
        const double at_y = (y + first + 0.5) * h;
        if ((at_y > band[0] && at_y < band[1]) != within) continue;
        const CellRow row{y, 0, own.lo[0], own.hi[0]};
        std::vector<double> u(3 * static_cast<std::size_t>(row.size()));
        fluid.velocity(std::vector{row}, u);
        for (int x = row.x_begin; x < row.x_end; ++x) {
            const Vec3 swirl = vortex.swirl({(x + 0.5) * h, at_y, 0}, time);
            const double* const found = &u[3 * static_cast<std::size_t>(x - row.x_begin)];
            sums.error += std::pow(found[0] - vortex.stream - swirl[0], 2) +
                          std::pow(found[1] - swirl[1], 2);
            sums.swirl += swirl[0] * swirl[0] + swirl[1] * swirl[1];
        }
    }
    return sums;
}

class RefinedBand : public testing::Test {
  protected:
    static constexpr RoundVortex vortex{};
    static constexpr int steps = 2560;  // two passes

    // Both grids that are uniform do once for all bands.
    static void SetUpTestSuite() {
        coarse = std::make_unique<Fluid>(MPI_COMM_WORLD, vortex.config());
        FluidConfig twice = vortex.config();
        twice.cells = {2 * vortex.cells, 2 * vortex.cells, 1};
        twice.spacing_m = twice.time_step_s = 0.5;
        fine = std::make_unique<Fluid>(MPI_COMM_WORLD, twice);
        for (int i = 0; i < steps; ++i) {
            coarse->step();
            fine->step();
            fine->step();
        }
    }
    static void TearDownTestSuite() {
        coarse.reset();
        fine.reset();
    }

    struct Found {
        double patch, fine, coarse;
        double outside, coarse_outside;
    };

    // Of a band of 28 coarse cells from there on.
    static Found carried(const char* name, int from) {
        const std::array<double, 2> band{from + 0.0, from + 28.0};
        const double n = vortex.cells, inset = 1e-6;
        RefinedFluid refined(
            MPI_COMM_WORLD,
            {.coarse = vortex.config(), .rule = {.slack_cells = 0, .follows = false}},
            {{Vec3{0.1, band[0] + inset, 0.1}, Vec3{n - 0.1, band[1] - inset, 0.9}}});
        for (int i = 0; i < 2 * steps; ++i) refined.step();
        const CellBox inside = refined.place(1).inside;
        EXPECT_EQ(inside.hi[0] - inside.lo[0], 2 * vortex.cells);
        EXPECT_EQ(inside.lo[1], 2 * from);
        EXPECT_EQ(inside.hi[1], 2 * (from + 28));
        const auto error = [&](const Fluid& fluid, bool within, int first = 0) {
            return squares(vortex, fluid, within, band, steps, first).relative();
        };
        const Found found{error(refined.level(1), true, refined.place(1).stored.lo[1]),
                          error(*fine, true), error(*coarse, true),
                          error(refined.level(0), false), error(*coarse, false)};
        std::printf(
            "%s: in the band %.3g %% (uniform fine %.3g %%, coarse %.3g %%), outside "
            "%.3g %% (coarse %.3g %%)\n",
            name, 100 * found.patch, 100 * found.fine, 100 * found.coarse,
            100 * found.outside, 100 * found.coarse_outside);
        EXPECT_LT(found.outside, 1.3 * found.coarse_outside) << name;
        return found;
    }

    static std::unique_ptr<Fluid> coarse, fine;
};
std::unique_ptr<Fluid> RefinedBand::coarse, RefinedBand::fine;

// 1.75 radii from the vortex the sides cut flow of half its largest speed.
TEST_F(RefinedBand, HasTheErrorOfTheFineGrid) {
    const Found found = carried("vortex in the middle", 18);
    EXPECT_LT(found.patch, 1.7 * found.fine);
}

// Where the fastest flow crosses a side, a part of the vortex itself is on coarse cells.
TEST_F(RefinedBand, HasNoMoreThanTheMeanWhereItCutsTheVortex) {
    const Found found = carried("side one radius from the vortex", 24);
    EXPECT_LT(found.patch, (found.fine + found.coarse) / 2);
}

}  // namespace
}  // namespace magfsi::fluid
