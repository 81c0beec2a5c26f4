// SPDX-License-Identifier: GPL-2.0-or-later
// Velocity, density, vorticity, sums and forces do not depend on the number of ranks.
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

// Values of all cells of the box, `size` per cell, at the cells of this rank.
std::vector<double> part(const std::vector<double>& whole, int size, const CellBox& box,
                         const std::array<int, 3>& cells) {
    std::vector<double> mine;
    const int row_size = size * cells[0];
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            const auto first = whole.begin() + (z * cells[1] + y) * row_size;
            mine.insert(mine.end(), first, first + row_size);
        }
    }
    return mine;
}

// Density (size 1) or velocity (3) of this rank's cells.
std::vector<double> field(const Fluid& fluid, int size) {
    if (size == 3) return velocity(fluid);
    const std::size_t cells = all_rows(fluid).size() * fluid.owned().hi[0];
    std::vector<float> u(3 * cells), density(cells);
    fluid.macroscopic(u, density);
    return {density.begin(), density.end()};
}

std::vector<double> vorticity(const Fluid& fluid) {
    std::vector<float> values(3 * all_rows(fluid).size() * fluid.owned().hi[0]);
    fluid.vorticity(values);
    return {values.begin(), values.end()};
}

FluidConfig lid_driven(bool periodic_z) {
    FluidConfig config = lattice_fluid({10, 6, 6}, 0.53, Collision::automatic);
    set_walls(config, 0);
    set_walls(config, 1);
    if (!periodic_z) set_walls(config, 2);
    config.boundaries[3].wall_velocity_m_s = {0.05, 0, 0.03};
    config.initial_velocity = stirred;
    return config;
}

void expect_close(double a, double b, const char* what) {
    EXPECT_NEAR(a, b, 1e-12 * std::abs(b)) << what;  // sums in another order
}

class Sampling : public testing::TestWithParam<bool> {};

TEST_P(Sampling, IsTheSameOnAnyRanks) {
    const FluidConfig config = lid_driven(GetParam());
    Fluid parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    for (int step = 0; step < 5; ++step) {
        EXPECT_EQ(vorticity(parallel),
                  part(vorticity(serial), 3, parallel.owned(), config.cells));
        const Totals a = parallel.totals(), b = serial.totals();
        expect_close(a.mass_kg, b.mass_kg, "mass");
        expect_close(a.kinetic_energy_j, b.kinetic_energy_j, "kinetic energy");
        expect_close(parallel.enstrophy_1_s2(), serial.enstrophy_1_s2(), "enstrophy");
        EXPECT_EQ(a.max_speed_m_s, b.max_speed_m_s);
        parallel.step();
        serial.step();
    }
}

INSTANTIATE_TEST_SUITE_P(PeriodicAlongZ, Sampling, testing::Bool());

// ---- With inlets, outlets, patches, free slip and obstacles on both sides of a cut.
// Forces differ by the order of their sums only.

struct Opened {
    const char* name;
    int inlet;
    BoundaryKind around;
    bool patches;
};

FluidConfig config_of(const Opened& c) {
    // Two cells at an outlet are the least that a rank may have: 4 ranks, 4 cuts.
    FluidConfig config = channel({10, 9, 8}, 0.53, c.inlet, 0.05, c.around);
    const int outlet = c.inlet ^ 1;
    config.boundaries[c.inlet].inlet.profile = InletProfile::plug;
    config.boundaries[c.inlet].inlet.ramp_s = 9;
    if (c.patches) {
        config.boundaries[c.inlet].patch = Disc{{4.2, 4.1}, 5};
        config.boundaries[outlet].patch = Rectangle{{4, 4}, {5, 4}};
    }
    config.obstacles = {{"ball", Sphere{{4.3, 4.6, 4.1}, 4}},
                        {"rod", Cylinder{{8, 0, 4.2}, 1.6, 1, {}}},
                        {"brick on sides", Block{{8.4, 7, 6}, {10, 9, 8}}}};
    config.initial_velocity = stirred;
    return config;
}

class Boundaries : public testing::TestWithParam<Opened> {};

TEST_P(Boundaries, AreTheSameOnAnyRanks) {
    const FluidConfig config = config_of(GetParam());
    Fluid parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    const CellBox box = parallel.owned();
    for (int step = 0; step < 31; ++step) {
        parallel.step();
        serial.step();
        for (const int size : {1, 3}) {
            ASSERT_EQ(field(parallel, size),
                      part(field(serial, size), size, box, config.cells))
                << "step " << step;
        }
        const std::vector<Vec3> a = parallel.obstacle_forces(),
                                b = serial.obstacle_forces();
        for (int i = 0; i < 9; ++i) {
            // Sums of hundreds of links of up to 0.01.
            EXPECT_NEAR(a[i / 3][i % 3], b[i / 3][i % 3], 1e-13);
        }
    }
    EXPECT_FALSE(serial.diverged());
}

constexpr auto wall = BoundaryKind::no_slip, slip = BoundaryKind::free_slip;

INSTANTIATE_TEST_SUITE_P(Boxes, Boundaries,
                         testing::Values(Opened{"InletXWalls", 0, wall, false},
                                         Opened{"InletXSlip", 0, slip, false},
                                         Opened{"InletYSlip", 2, slip, false},
                                         Opened{"InletYWalls", 3, wall, false},
                                         Opened{"InletZSlip", 5, slip, false},
                                         Opened{"InletZWalls", 4, wall, true},
                                         Opened{"PatchesX", 1, wall, true},
                                         Opened{"PatchesY", 2, wall, true}),
                         [](const auto& box) { return std::string(box.param.name); });

// ---- What goes through planes across a developed channel, in closed form: the volume
// flow is the inlet's everywhere, the flux of momentum 6/5 rho U^2 A, and the pressure
// falls by 12 rho nu U / H^2 per length.

constexpr double speed = 0.002;
constexpr int height = 16, width = 3;

FluidConfig plane_channel() {
    FluidConfig config =
        channel({60, height, width}, 0.8, 0, speed, BoundaryKind::no_slip);
    config.boundaries[4].kind = config.boundaries[5].kind = BoundaryKind::periodic;
    config.boundaries[0].inlet.profile = InletProfile::parabolic;
    config.boundaries[0].inlet.ramp_s = 200;  // at once, layers would alternate by 1e-3
    return config;
}

TEST(PlaneFlow, IsThatOfPoiseuille) {
    Fluid fluid(MPI_COMM_WORLD, plane_channel());
    advance(fluid, 6000);  // 2.3 times H^2 / nu: exp(-pi^2 2.3) of the start is left
    const double area = height * width;
    const PlaneFlow near = fluid.plane_flow(0, 20.3), far = fluid.plane_flow(0, 40.3);
    // Mass is kept, also where its density falls, by 3 * 12 nu U 40 / H^2 = 1.1e-3.
    EXPECT_NEAR(near.flow_m3_s / (speed * area), 1, 2e-4);
    EXPECT_NEAR(far.flow_m3_s / (speed * area), 1, 2e-4);
    // And the midpoint rule over 16 cells: 1 / (2 * 16^2).
    EXPECT_NEAR(near.momentum_flux_n[0] / (1.2 * speed * speed * area), 1, 8e-3);
    EXPECT_NEAR(near.momentum_flux_n[1] / (speed * speed * area), 0, 1e-3);
    const double viscosity = fluid.config().viscosity_m2_s;
    const double fall = 12 * viscosity * speed / (height * height) * 20;
    EXPECT_NEAR((near.pressure_pa - far.pressure_pa) / fall, 1, 1e-2);
    // Nothing goes through the walls and across the depth.
    EXPECT_NEAR(fluid.plane_flow(1, 8.2).flow_m3_s / (speed * area), 0, 2e-3);
    EXPECT_NEAR(fluid.plane_flow(2, 1.2).flow_m3_s / (speed * area), 0, 1e-12);
}

// Around an obstacle what flows is the same, through less of the plane; on any ranks.
TEST(PlaneFlow, IsTheSameOnAnyRanksAlsoAtObstacles) {
    FluidConfig config = plane_channel();
    config.obstacles = {{"brick", Block{{20, 5, -1}, {28, 11, 9}}},
                        {"ball", Sphere{{40, 7.3, 1.6}, 5}}};
    Fluid parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    advance(parallel, 3000);
    advance(serial, 3000);
    for (const int axis : {0, 1, 2}) {
        const std::vector<double> places =
            axis == 0   ? std::vector{24.0, 24.7, 37.9, 40.6, 42.1}
            : axis == 1 ? std::vector{0.0, 0.7, 5.2, 7.5, 9.6}
                        : std::vector{0.0, 0.7, 2.1};
        for (const double place : places) {
            const PlaneFlow a = parallel.plane_flow(axis, place);
            const PlaneFlow b = serial.plane_flow(axis, place);
            // Rounding of sums over some hundred cells in another order.
            EXPECT_NEAR(a.flow_m3_s, b.flow_m3_s, 1e-14);
            EXPECT_NEAR(a.pressure_pa, b.pressure_pa, 1e-15);
            for (int d = 0; d < 3; ++d)
                EXPECT_NEAR(a.momentum_flux_n[d], b.momentum_flux_n[d], 1e-15);
        }
    }
    // The brick's faces lie half a cell from the cells, where bounce-back keeps mass.
    EXPECT_NEAR(serial.plane_flow(0, 24).flow_m3_s / serial.plane_flow(0, 10).flow_m3_s,
                1, 5e-4);
}

// ---- Through planes that cut a rod at any place flows what the inlet brings. The cells
// alone lack 0.9 % where the rod is 8 cells thick, and 0.24 % where it is 16.

// Largest error of the flow through planes at the rod, over the inlet's. size: multiple
// of the coarser grid.
double worst_flow_past_a_rod(int size) {
    constexpr double inlet = 0.0075;
    FluidConfig config =
        channel({40 * size, 20 * size, 1}, 0.8, 0, inlet / size, BoundaryKind::no_slip);
    config.boundaries[4].kind = config.boundaries[5].kind = BoundaryKind::periodic;
    config.boundaries[0].inlet.profile = InletProfile::parabolic;
    config.boundaries[0].inlet.ramp_s = 50 * size * size;
    const double n = size;
    config.obstacles = {
        {"rod", Cylinder{{50 * n / 3, 29 * n / 3, 0}, 8 * n, 2, std::nullopt}}};
    Fluid fluid(MPI_COMM_WORLD, config);
    advance(fluid, 3600);  // 2.2 times H^2 / (pi^2 nu) of the finer grid
    double worst = 0;
    for (double at = 11 * n; at < 22 * n; at += 0.37) {
        const double flow = fluid.plane_flow(0, at).flow_m3_s / (inlet * 20);
        worst = std::max(worst, std::abs(flow - 1));
    }
    std::printf("rod of %d cells: largest error of the flow %.2e\n", 8 * size, worst);
    return worst;
}

TEST(PlaneFlow, IsTheInletsWhereverThePlaneCutsAnObstacle) {
    const double coarse = worst_flow_past_a_rod(1), fine = worst_flow_past_a_rod(2);
    // Walls between cells lose and make mass of the second order in the spacing: behind
    // the rod 0.5 % more flows than before it.
    EXPECT_LT(coarse, 7e-3);
    EXPECT_LT(fine, 1.4e-3);
    EXPECT_LT(fine, coarse / 3);
}

// ---- A plane flow in a periodic slab is the same one cell deep and four cells deep.

FluidConfig slab(int depth, int axis) {
    std::array<int, 3> cells{24, 12, 12};
    cells[axis] = depth;
    FluidConfig config = channel(cells, 0.55, 0, 0.05, BoundaryKind::no_slip);
    config.boundaries[2 * axis].kind = BoundaryKind::periodic;
    config.boundaries[2 * axis + 1].kind = BoundaryKind::periodic;
    config.boundaries[0].inlet.profile = InletProfile::parabolic;
    config.obstacles = {{"rod", Cylinder{{7.2, 5.7, 5.7}, 4, axis, {}}}};
    return config;
}

// Largest difference of the velocities of this rank's cells.
double difference(const Fluid& one, const Fluid& deep, int axis) {
    const auto thin = all_rows(one);
    std::vector<double> u(3 * thin.size() * thin.front().size());
    one.velocity(thin, u);
    std::size_t first = 0;
    double largest = 0;
    const CellBox owned = deep.owned();
    for (CellRow row : thin) {
        // The middle plane of four; the fluids may be cut into ranks along other axes.
        (axis == 1 ? row.y : row.z) = 2;
        const bool here = row.y >= owned.lo[1] && row.y < owned.hi[1] &&
                          row.z >= owned.lo[2] && row.z < owned.hi[2];
        std::vector<double> v(3 * static_cast<std::size_t>(row.size()));
        if (here) {
            deep.velocity({&row, 1}, v);
            for (std::size_t i = 0; i < v.size(); ++i)
                largest = std::max(largest, std::abs(v[i] - u[first + i]));
        }
        first += v.size();
    }
    return largest;
}

TEST(ThinSlab, OneCellIsAsDeepAsFour) {
    for (const int axis : {1, 2}) {
        Fluid one(MPI_COMM_WORLD, slab(1, axis)), deep(MPI_COMM_WORLD, slab(4, axis));
        advance(one, 101);  // both arrangements of in-place streaming
        advance(deep, 101);
        // Rounding of sums in another order, over 100 steps of 0.05.
        EXPECT_LT(difference(one, deep, axis), 1e-14) << "axis " << axis;
        const double force = one.obstacle_forces()[0][0];
        EXPECT_GT(force, 1e-4);
        EXPECT_NEAR(deep.obstacle_forces()[0][0] / (4 * force), 1, 1e-10);
    }
}

}  // namespace
}  // namespace magfsi::fluid
