// Steady drag of a sphere in a stream: a quarter of the box, with free slip on the two
// planes of symmetry and on the outer sides.
#pragma once

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "tests/unit/fluid_lbm/lattice_fluid.h"
#include "tests/validation/fluid_lbm/reference_table.h"

namespace magfsi::fluid {

struct SphereRun {
    double reynolds = 20;  // on the diameter
    int diameter = 8;      // cells
    // Diameters from the centre to the inlet, the outlet and the outer sides.
    double upstream = 6, downstream = 8, sideways = 6;
    double speed = 0.05;  // lattice units
    ObstacleWall wall = ObstacleWall::interpolated;
    Collision collision = Collision::automatic;
    double convective_times = 60;  // diameters over speed
};

inline FluidConfig sphere_in_stream(const SphereRun& run) {
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
    config.obstacle_wall = run.wall;
    config.initial_velocity = [u = run.speed](const Vec3&) { return Vec3{u, 0, 0}; };
    return config;
}

// Drag over rho U^2 / 2 and the sphere's cross-section.
inline double drag_coefficient(const SphereRun& run) {
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
inline double reference_drag(double reynolds) {
    double drag = 0;
    for (const auto& row : read_table(SPHERE_REFERENCE)) {
        if (std::stod(row[0]) == reynolds) drag = std::stod(row[1]);
    }
    return drag;
}

}  // namespace magfsi::fluid
