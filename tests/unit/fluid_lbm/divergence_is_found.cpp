// A cell that went wrong is named by its global index, in both arrangements.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

FluidConfig calm() {
    return lattice_fluid({9, 6, 5}, 0.8, Collision::automatic);
}

bool owns(const Fluid& fluid, int y, int z) {
    const CellBox box = fluid.owned();
    return y >= box.lo[1] && y < box.hi[1] && z >= box.lo[2] && z < box.hi[2];
}

TEST(Divergence, CalmFluidHasNone) {
    Fluid fluid(MPI_COMM_WORLD, calm());
    EXPECT_FALSE(fluid.divergence());
    fluid.step();
    EXPECT_FALSE(fluid.divergence());
}

TEST(Divergence, NamesTheCellThatIsNotFinite) {
    FluidConfig config = calm();
    config.initial_pressure = [](const Vec3& x) {
        return x == Vec3{3.5, 4.5, 2.5} ? NAN : 0.0;
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const auto found = fluid.divergence();
    ASSERT_EQ(found.has_value(), owns(fluid, 4, 2));
    if (!found) return;
    EXPECT_EQ(found->cell, (std::array<int, 3>{3, 4, 2}));
}

TEST(Divergence, NamesTheCellThatIsTooFast) {
    Fluid fluid(MPI_COMM_WORLD, calm());
    std::vector<CellRow> row;
    std::vector<double> force;
    if (owns(fluid, 2, 1)) {
        row.push_back({2, 1, 7, 8});
        force = {3, 0, 0};  // accelerates the neighbours downstream beyond the limit
    }
    fluid.set_force(row, force);
    fluid.step();
    const auto found = fluid.divergence();
    int any = found.has_value();
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    ASSERT_EQ(any, 1);
    if (found) {
        EXPECT_GT(found->lattice_speed, 0.4);
        EXPECT_LE(std::abs(found->cell[1] - 2), 1);
        EXPECT_LE(std::abs(found->cell[2] - 1), 1);
    }
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

TEST_P(NextStep, NamesAValueThatIsNotFinite) {
    FluidConfig c = config();
    c.initial_pressure = [](const Vec3& x) { return is_bad_cell(x) ? NAN : 0.0; };
    expect_next_step_names(c, DivergenceCause::not_finite);
}

TEST_P(NextStep, NamesASpeedAboveTheLimit) {
    FluidConfig c = config();
    c.initial_velocity = [](const Vec3& x) {
        return is_bad_cell(x) ? Vec3{0.3, -0.3, 0.1} : Vec3{};
    };
    expect_next_step_names(c, DivergenceCause::speed);
}

TEST_P(NextStep, NamesALowRelaxationTime) {
    FluidConfig c = config();
    c.viscosity_m2_s = 0.001 / 3;
    c.initial_velocity = [](const Vec3& x) {
        return is_bad_cell(x) ? Vec3{0.3, -0.3, 0.1} : Vec3{};
    };
    expect_next_step_names(c, DivergenceCause::relaxation_time);
}

TEST_P(NextStep, NamesADensityBelowZero) {
    FluidConfig c = config();
    // Pressure is a third of the density: - 1.2 of it.
    c.initial_pressure = [](const Vec3& x) { return is_bad_cell(x) ? -0.4 : 0.0; };
    expect_next_step_names(c, DivergenceCause::speed);
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

INSTANTIATE_TEST_SUITE_P(Precisions, NextStep,
                         testing::Values(Precision::double_, Precision::float_,
                                         Precision::float_double));

// A shear that breaks up with hardly any viscosity: what a search after every step finds,
// the next step has named on its own, and no value was infinite by then.
TEST(Divergence, OfAnUnstableRunIsNamedByTheNextStep) {
    FluidConfig config = lattice_fluid({12, 8, 8}, 0.5002, Collision::trt);
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.2 * std::sin(3 * x[1]), 0.2 * std::cos(5 * x[2]), 0.02 * x[0] / 12};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 500; ++step) {
        const auto before = fluid.divergence();
        fluid.step();
        const auto found = fluid.diverged();
        EXPECT_EQ(found.has_value(), before.has_value()) << "step " << step;
        if (found && before) {
            EXPECT_GT(step, 0) << "it must start sound";
            EXPECT_EQ(found->cell, before->cell);
            EXPECT_EQ(found->step, step);
            EXPECT_TRUE(std::isfinite(found->lattice_speed));
            EXPECT_EQ(found->cause, DivergenceCause::relaxation_time);
            std::printf("%s\n", to_string(*found).c_str());
        }
        int any = found.has_value() || before.has_value();
        MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
        if (any != 0) return;
    }
    FAIL() << "the run stayed stable; it cannot show anything";
}

}  // namespace
}  // namespace magfsi::fluid
