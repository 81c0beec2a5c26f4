// SPDX-License-Identifier: GPL-2.0-or-later
// Steady drag of a sphere in a stream: a quarter of the box, with free slip on the two
// planes of symmetry and on the outer sides.
#include <cstdlib>
#include <numbers>
#include <string>

#include "tests/unit/fluid_lbm/lattice_fluid.h"
#include "tests/validation/fluid_lbm/references.h"

namespace magfsi::fluid {
namespace {

struct SphereRun {
    double reynolds = 20;  // on the diameter
    int diameter = 8;      // cells
    // Diameters from the centre to the inlet, the outlet and the outer sides.
    double upstream = 6, downstream = 8, sideways = 6;
    double speed = 0.05;  // lattice units
    Collision collision = Collision::automatic;
    double convective_times = 60;  // diameters over speed
};

FluidConfig sphere_in_stream(const SphereRun& run) {
    const auto cells = [&](double diameters) {
        return static_cast<int>(std::lround(diameters * run.diameter));
    };
    FluidConfig config = lattice_fluid(
        {cells(run.upstream + run.downstream), cells(run.sideways), cells(run.sideways)},
        0.6, run.collision);
    config.viscosity_m2_s = run.speed * run.diameter / run.reynolds;
    for (Boundary& side : config.boundaries) side.kind = BoundaryKind::free_slip;
    config.boundaries[0].kind = BoundaryKind::velocity_inlet;
    config.boundaries[0].inlet.velocity_m_s = {run.speed, 0, 0};
    config.boundaries[1].kind = BoundaryKind::pressure_outlet;
    // Off the lattice's own symmetries.
    const double x = cells(run.upstream) + 0.3;
    config.obstacles = {{"sphere", Sphere{{x, 0, 0}, static_cast<double>(run.diameter)}}};
    config.initial_velocity = [u = run.speed](const Vec3&) { return Vec3{u, 0, 0}; };
    return config;
}

// Drag over rho U^2 / 2 and the sphere's cross-section.
double drag_coefficient(const SphereRun& run) {
    Fluid fluid(MPI_COMM_WORLD, sphere_in_stream(run));
    const int steps = static_cast<int>(run.convective_times * run.diameter / run.speed);
    const int averaged = steps / 20;  // sound that is left in the box
    double force = 0;
    for (int i = 0; i < steps; ++i) {
        fluid.step();
        if (i >= steps - averaged) force += fluid.obstacle_forces()[0][0] / averaged;
    }
    const double area = std::numbers::pi / 4 * run.diameter * run.diameter;
    return 4 * force / (0.5 * run.speed * run.speed * area);
}

// Finite elements, outer radius of 80 diameters where there is one.
double reference_drag(double reynolds) {
    double drag = 0;
    for (const auto& row : read_table(SPHERE_REFERENCE)) {
        if (std::stod(row[0]) == reynolds) drag = std::stod(row[1]);
    }
    return drag;
}

#ifdef LONG_RUNS

// In an unbounded stream, from three runs: the spacing's error by Richardson's
// extrapolation with the order 2 of interpolated walls, that of the box by its doubling,
// as falling with the square of its width (the blocked area).
class SphereDragLong : public testing::TestWithParam<double> {};

TEST_P(SphereDragLong, IsThatOfAnUnboundedStream) {
    SphereRun coarse;
    coarse.reynolds = GetParam();
    coarse.diameter = 10;
    coarse.upstream = 4;
    coarse.downstream = 5;
    coarse.sideways = 3;
    coarse.speed = 0.1;
    coarse.convective_times = 20;
    // One collision for all three grids, or the extrapolation compares different errors:
    // the one that `automatic` takes for the smallest relaxation time of the three.
    coarse.collision =
        coarse.reynolds < 50 ? Collision::trt : Collision::recursive_regularized;
    SphereRun fine = coarse, wide = coarse;
    fine.diameter *= 2;
    wide.upstream *= 2;
    wide.sideways *= 2;
    const double c = drag_coefficient(coarse), f = drag_coefficient(fine),
                 w = drag_coefficient(wide), reference = reference_drag(GetParam());
    const double drag = f + (f - c) / 3 + (w - c) * 4 / 3;
    std::printf(
        "Re %g: coarse %.4f, fine %.4f, wide %.4f; unbounded %.4f, reference %.4f, "
        "%+.2f %%\n",
        GetParam(), c, f, w, drag, reference, 100 * (drag / reference - 1));
    EXPECT_LT(std::abs(drag / reference - 1), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Reynolds, SphereDragLong, testing::Values(20, 100, 200));

#else

TEST(SphereDrag, IsRightOnACoarseGrid) {
    SphereRun run;
    run.reynolds = 20;
    run.diameter = 6;
    run.upstream = 4;
    run.downstream = 6;
    run.sideways = 4;
    run.speed = 0.08;
    run.convective_times = 20;
    const double drag = drag_coefficient(run), reference = reference_drag(20);
    std::printf("drag coefficient %.4f, reference %.4f, %+.2f %%\n", drag, reference,
                100 * (drag / reference - 1));
    // 6 cells per diameter, and a box of 8 x 8 diameters across, whose sides raise the
    // drag by 2 % (the difference to a box of 16 x 16).
    EXPECT_NEAR(drag / reference, 1, 0.05);
}

#endif

}  // namespace
}  // namespace magfsi::fluid
