// Velocity and density are the same, to the last bit, on one rank and on several: with
// inlets, outlets, patches, free slip and obstacles on both sides of a cut. Forces differ
// by the order of their sums only.
#include <gtest/gtest.h>

#include "tests/unit/fluid_boundary/channel.h"

namespace magfsi::fluid {
namespace {

struct Case {
    const char* name;
    int inlet;
    BoundaryKind around;
    bool patches;
};

FluidConfig config_of(const Case& c) {
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
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.02 * std::sin(x[1] + x[2]), 0.02 * std::cos(x[0]), 0.01 * x[1] / 6};
    };
    return config;
}

// Density and velocity of the cells of `box`, which the fluid must own.
std::vector<float> part(const Fluid& fluid, const CellBox& box) {
    const CellBox own = fluid.owned();
    std::size_t cells = 1;
    for (int a = 0; a < 3; ++a) cells *= own.hi[a] - own.lo[a];
    std::vector<float> u(3 * cells), density(cells), values;
    fluid.macroscopic(u, density);
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            for (int x = box.lo[0]; x < box.hi[0]; ++x) {
                const std::size_t i =
                    (static_cast<std::size_t>(z - own.lo[2]) * (own.hi[1] - own.lo[1]) +
                     y - own.lo[1]) *
                        own.hi[0] +
                    x;
                values.push_back(density[i]);
                values.insert(values.end(), u.begin() + 3 * i, u.begin() + 3 * i + 3);
            }
        }
    }
    return values;
}

std::vector<double> velocity_of(const Fluid& fluid, const CellBox& box) {
    std::vector<CellRow> rows;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            rows.push_back({y, z, box.lo[0], box.hi[0]});
        }
    }
    std::vector<double> u(3 * rows.size() * rows.front().size());
    fluid.velocity(rows, u);
    return u;
}

class Boundaries : public testing::TestWithParam<Case> {};

TEST_P(Boundaries, AreTheSameOnAnyRanks) {
    const FluidConfig config = config_of(GetParam());
    Fluid parallel(MPI_COMM_WORLD, config), serial(MPI_COMM_SELF, config);
    const CellBox box = parallel.owned();
    for (int step = 0; step < 31; ++step) {
        parallel.step();
        serial.step();
        ASSERT_EQ(velocity_of(parallel, box), velocity_of(serial, box)) << step;
        ASSERT_EQ(part(parallel, box), part(serial, box)) << "step " << step;
        const std::vector<Vec3> a = parallel.obstacle_forces(),
                                b = serial.obstacle_forces();
        for (int i = 0; i < 9; ++i) {
            // Sums of hundreds of links of up to 0.01.
            EXPECT_NEAR(a[i / 3][i % 3], b[i / 3][i % 3], 1e-13);
        }
    }
    EXPECT_FALSE(serial.divergence());
}

constexpr auto wall = BoundaryKind::no_slip, slip = BoundaryKind::free_slip;

INSTANTIATE_TEST_SUITE_P(Boxes, Boundaries,
                         testing::Values(Case{"InletXWalls", 0, wall, false},
                                         Case{"InletXSlip", 0, slip, false},
                                         Case{"InletYSlip", 2, slip, false},
                                         Case{"InletYWalls", 3, wall, false},
                                         Case{"InletZSlip", 5, slip, false},
                                         Case{"InletZWalls", 4, wall, true},
                                         Case{"PatchesX", 1, wall, true},
                                         Case{"PatchesY", 2, wall, true}),
                         [](const auto& box) { return std::string(box.param.name); });

}  // namespace
}  // namespace magfsi::fluid
