// SPDX-License-Identifier: GPL-2.0-or-later
// What is read from the fluid: velocity, vorticity, the cell that diverged.
#include <numbers>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

// ---- velocity() reads the same flow from both arrangements of the populations, for any
// row length and any part of a row.

class VelocityInBothStates : public testing::TestWithParam<int> {};

TEST_P(VelocityInBothStates, OfUniformFlow) {
    for (Collision collision :
         {Collision::bgk, Collision::trt, Collision::recursive_regularized,
          Collision::recursive_mrt}) {
        FluidConfig config = lattice_fluid({GetParam(), 4, 3}, 0.6, collision);
        const Vec3 wind{0.05, -0.03, 0.02};
        config.initial_velocity = [&](const Vec3&) { return wind; };
        Fluid fluid(MPI_COMM_WORLD, config);
        for (int step = 0; step < 5; ++step) {
            const std::vector<double> u = velocity(fluid);
            for (std::size_t i = 0; i < u.size(); ++i) {
                // A few roundings of f - w near 1e-2 a step.
                ASSERT_NEAR(u[i], wind[i % 3], 2e-15) << "step " << step;
            }
            fluid.step();
        }
    }
}

TEST_P(VelocityInBothStates, OfPartsOfRows) {
    const int nx = GetParam();
    FluidConfig config = lattice_fluid({nx, 4, 3}, 0.6, Collision::automatic);
    set_walls(config, 0);
    set_walls(config, 1);
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.01 * x[1], 0.02 / (1 + x[0]), 0.01 * x[2] * x[0] / 30};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 3; ++step) {
        const std::vector<double> whole = velocity(fluid);
        std::size_t first = 0;
        for (const CellRow& row : all_rows(fluid)) {
            for (int begin = 0; begin < nx; begin += 3) {
                CellRow part = row;
                part.x_begin = begin;
                part.x_end = std::min(begin + 4, nx);
                std::vector<double> u(3 * part.size());
                fluid.velocity(std::span(&part, 1), u);
                for (std::size_t i = 0; i < u.size(); ++i) {
                    ASSERT_EQ(u[i], whole[first + 3 * begin + i]);
                }
            }
            first += 3 * row.size();
        }
        fluid.step();
    }
}

INSTANTIATE_TEST_SUITE_P(RowLengths, VelocityInBothStates, testing::Values(5, 8, 13, 33));

// ---- Vorticity and enstrophy of flows whose difference quotients are known: a sine, and
// parabolas, which central and one-sided differences at (moving) walls reproduce exactly.

constexpr double spacing_m = 1e-4;

FluidConfig water(std::array<int, 3> cells) {
    FluidConfig config;
    config.cells = cells;
    config.spacing_m = spacing_m;
    config.time_step_s = 1e-5;
    config.density_kg_m3 = 1000;
    config.viscosity_m2_s = 1e-6;
    return config;
}

TEST(Curl, OfASineIsThatOfCentralDifferences) {
    constexpr int n = 12;
    constexpr double k = 2 * std::numbers::pi / (n * spacing_m), amplitude = 0.1;
    FluidConfig config = water({5, n, 6});
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{amplitude * std::sin(k * x[1]), 0, 0};
    };
    const Fluid fluid(MPI_COMM_WORLD, config);
    const double slope = amplitude * std::sin(k * spacing_m) / spacing_m;
    // Mean of cos^2 / 2; rounding of a sum over 360 cells.
    EXPECT_NEAR(fluid.enstrophy_1_s2(), slope * slope / 4, 1e-13 * slope * slope);
}

// A flow in all directions, between walls along one axis: the mean over rows is that of
// the cells one by one.
TEST(Enstrophy, is_that_of_the_vorticity) {
    for (const int normal : {0, 1, 2}) {
        FluidConfig config = water({7, 8, 9});
        set_walls(config, normal);
        config.initial_velocity = [](const Vec3& x) {
            const auto s = [](double a) { return 0.05 * std::sin(a / spacing_m); };
            return Vec3{s(x[1] + 2 * x[2]), s(x[0] - x[2]), s(2 * x[0] + x[1])};
        };
        const Fluid fluid(MPI_COMM_WORLD, config);
        std::vector<float> curl(3 * 7 * all_rows(fluid).size());
        fluid.vorticity(curl);
        double mean = 0;
        for (const float w : curl) mean += 0.5 * w * w / (7 * 8 * 9);
        MPI_Allreduce(MPI_IN_PLACE, &mean, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        // Single precision of each.
        EXPECT_NEAR(fluid.enstrophy_1_s2(), mean, 1e-6 * mean);
    }
}

// u along one axis, a parabola of the position along the wall's normal.
class CurlAtWalls : public testing::TestWithParam<int> {
  protected:
    void check(double force_n_m3);
};

// A body force moves the populations' momentum half a step behind the velocity.
TEST_P(CurlAtWalls, OfAParabolaIsExactWithABodyForce) {
    check(1e4);
}
TEST_P(CurlAtWalls, OfAParabolaIsExact) {
    check(0);
}

void CurlAtWalls::check(double force_n_m3) {
    const int normal = GetParam(), along = (normal + 1) % 3, third = (normal + 2) % 3;
    constexpr double a = 0.01, b = 30, c = -4e4;  // m/s, 1/s, 1/(m s)
    FluidConfig config = water({6, 6, 6});
    set_walls(config, normal);
    const auto u = [](double s) { return a + b * s + c * s * s; };
    if (force_n_m3 != 0) {
        config.body_force_n_m3.emplace(Vec3{});
        (*config.body_force_n_m3)[along] = force_n_m3;
    }
    config.boundaries[2 * normal].wall_velocity_m_s[along] = u(0);
    config.boundaries[2 * normal + 1].wall_velocity_m_s[along] = u(6 * spacing_m);
    config.initial_velocity = [&](const Vec3& x) {
        Vec3 velocity{};
        velocity[along] = u(x[normal]);
        return velocity;
    };
    const Fluid fluid(MPI_COMM_WORLD, config);
    std::vector<float> curl(3 * 6 * all_rows(fluid).size());
    fluid.vorticity(curl);
    const float* value = curl.data();
    for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3&) {
        const double s = (cell[normal] + 0.5) * spacing_m;
        // curl_k = d u_j / d x_i for (i, j, k) in cyclic order. Single precision of
        // values near 30.
        EXPECT_NEAR(value[third], b + 2 * c * s, 1e-5);
        EXPECT_NEAR(value[normal], 0, 1e-5);
        EXPECT_NEAR(value[along], 0, 1e-5);
        value += 3;
    });
}

INSTANTIATE_TEST_SUITE_P(Normals, CurlAtWalls, testing::Values(0, 1, 2));

// ---- A cell that went wrong is named by its global index, in both arrangements.

FluidConfig calm() {
    return lattice_fluid({9, 6, 5}, 0.8, Collision::automatic);
}

bool owns(const Fluid& fluid, int y, int z) {
    const CellBox box = fluid.owned();
    return y >= box.lo[1] && y < box.hi[1] && z >= box.lo[2] && z < box.hi[2];
}

TEST(Divergence, CalmFluidHasNone) {
    Fluid fluid(MPI_COMM_WORLD, calm());
    advance(fluid, 2);
    EXPECT_FALSE(fluid.diverged());
}

// What the next step says of a state with one bad cell, on the rank that owns it.
void expect_next_step_names(const FluidConfig& config, DivergenceCause cause) {
    Fluid fluid(MPI_COMM_WORLD, config);
    EXPECT_FALSE(fluid.diverged());
    fluid.step();
    const auto found = fluid.diverged();
    fluid.step();
    ASSERT_EQ(found.has_value(), owns(fluid, 4, 2));
    if (!found) return;
    EXPECT_EQ(found->cell, (std::array<int, 3>{3, 4, 2}));
    EXPECT_EQ(found->position_m, (Vec3{3.5, 4.5, 2.5}));
    EXPECT_EQ(found->step, 0);
    EXPECT_EQ(found->cause, cause) << to_string(*found);
    EXPECT_NE(to_string(*found).find("cell (3, 4, 2)"), std::string::npos);
    EXPECT_EQ(fluid.diverged()->step, 0) << "the first find is kept";
}

class NextStep : public testing::TestWithParam<Precision> {
  protected:
    FluidConfig config() const {
        FluidConfig c = calm();
        c.precision = GetParam();
        return c;
    }
    static bool is_bad_cell(const Vec3& x) { return x == Vec3{3.5, 4.5, 2.5}; }
};

TEST_P(NextStep, NamesTheCellAndItsCause) {
    struct Bad {
        double pressure;
        Vec3 velocity;
        double viscosity;
        DivergenceCause cause;
    };
    const Vec3 fast{0.3, -0.3, 0.1};
    // Pressure is a third of the density: - 1.2 of it.
    for (const Bad& bad : {Bad{NAN, {}, 0.1, DivergenceCause::not_finite},
                           Bad{0, fast, 0.1, DivergenceCause::speed},
                           Bad{0, fast, 0.001 / 3, DivergenceCause::relaxation_time},
                           Bad{-0.4, {}, 0.1, DivergenceCause::speed}}) {
        FluidConfig c = config();
        c.viscosity_m2_s = bad.viscosity;
        c.initial_pressure = [&](const Vec3& x) {
            return is_bad_cell(x) ? bad.pressure : 0.0;
        };
        c.initial_velocity = [&](const Vec3& x) {
            return is_bad_cell(x) ? bad.velocity : Vec3{};
        };
        expect_next_step_names(c, bad.cause);
    }
}

TEST_P(NextStep, NamesAForceInTheStepInWhichItActs) {
    for (const double push : {1.0, static_cast<double>(NAN)}) {
        Fluid fluid(MPI_COMM_WORLD, config());
        fluid.step();
        std::vector<CellRow> row;
        std::vector<double> force;
        if (owns(fluid, 2, 1)) {
            row.push_back({2, 1, 7, 8});
            force = {push, 0, 0};
        }
        fluid.set_force(row, force);
        fluid.step();
        const auto found = fluid.diverged();
        EXPECT_EQ(found.has_value(), owns(fluid, 2, 1));
        if (!found) continue;
        EXPECT_EQ(found->cell, (std::array<int, 3>{7, 2, 1}));
        EXPECT_EQ(found->step, 1);
        EXPECT_EQ(found->cause, DivergenceCause::force) << to_string(*found);
    }
}

INSTANTIATE_TEST_SUITE_P(Precisions, NextStep, every_precision);

// The first cell of this rank that is too fast, by the velocity that the next collision
// sees.
std::optional<std::array<int, 3>> too_fast(const Fluid& fluid) {
    std::optional<std::array<int, 3>> first;
    for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3& u) {
        const bool slow = norm(u) <= 0.4;
        if (!first && !slow) first = cell;
    });
    return first;
}

// A shear that breaks up with hardly any viscosity: what a search after every step finds,
// the next step has named on its own, and no value was infinite by then.
TEST(Divergence, OfAnUnstableRunIsNamedByTheNextStep) {
    FluidConfig config = lattice_fluid({12, 8, 8}, 0.5002, Collision::trt);
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.2 * std::sin(3 * x[1]), 0.2 * std::cos(5 * x[2]), 0.02 * x[0] / 12};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 500; ++step) {
        const auto before = too_fast(fluid);
        fluid.step();
        const auto found = fluid.diverged();
        EXPECT_EQ(found.has_value(), before.has_value()) << "step " << step;
        if (found && before) {
            EXPECT_GT(step, 0) << "it must start valid";
            EXPECT_EQ(found->cell, *before);
            EXPECT_EQ(found->step, step);
            EXPECT_TRUE(std::isfinite(found->lattice_speed));
            EXPECT_EQ(found->cause, DivergenceCause::relaxation_time);
            std::printf("%s\n", to_string(*found).c_str());
        }
        if (on_any_rank(found.has_value() || before.has_value())) return;
    }
    FAIL() << "the run stayed stable; it cannot show anything";
}

// A remedy that is in force already, or that the configuration refuses, is not advised.
TEST(Divergence, AdvisesWhatCanBeFollowed) {
    const auto said = [](FluidConfig config) {
        config.initial_velocity = [](const Vec3&) { return Vec3{0.5, 0, 0}; };
        Fluid fluid(MPI_COMM_WORLD, config);
        fluid.step();
        return to_string(*fluid.diverged());
    };
    FluidConfig config = lattice_fluid({9, 6, 5}, 0.501, Collision::trt);
    test::expect_says(said(config), {"fluid.smagorinsky", "recursive_regularized"});
    config.smagorinsky_constant = 0.1;
    config.collision = Collision::recursive_regularized;
    const std::string text = said(config);
    EXPECT_EQ(text.find("smagorinsky"), std::string::npos) << text;
    EXPECT_EQ(text.find("recursive"), std::string::npos) << text;
}

// A thinning fluid is thick at rest, and thin where it diverges.
TEST(Divergence, NamesTheRelaxationTimeOfAThinningFluid) {
    FluidConfig config = lattice_fluid({9, 6, 5}, 0.8, Collision::automatic);
    config.rheology = Rheology{PowerLaw{0.1, 1e-3, 1e-4, 0.1}};
    config.initial_velocity = [](const Vec3&) { return Vec3{0.5, 0, 0}; };
    Fluid fluid(MPI_COMM_WORLD, config);
    fluid.step();
    const auto found = fluid.diverged();
    ASSERT_TRUE(found);
    EXPECT_LT(found->relaxation_time, 0.502);
    EXPECT_EQ(found->cause, DivergenceCause::relaxation_time);
}

// ---- Rows outside the rank's box and values that do not match them are refused.

TEST(ForeignRows, AreRefused) {
    Fluid fluid(MPI_COMM_WORLD, lattice_fluid({9, 6, 5}, 0.8, Collision::automatic));
    const CellBox box = fluid.owned();
    const CellRow good{box.lo[1], box.lo[2], 0, 9};
    std::vector<double> values(27);
    EXPECT_NO_THROW(fluid.velocity(std::span(&good, 1), values));
    CellRow outside = good;
    outside.y = box.hi[1];
    CellRow beyond = good;
    beyond.x_begin = 1;
    beyond.x_end = 10;
    for (const CellRow& row : {outside, beyond}) {
        EXPECT_THROW(fluid.velocity(std::span(&row, 1), values), std::invalid_argument);
        EXPECT_THROW(fluid.set_force(std::span(&row, 1), values), std::invalid_argument);
    }
    values.pop_back();
    EXPECT_THROW(fluid.set_force(std::span(&good, 1), values), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::fluid
