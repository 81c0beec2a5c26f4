#include "fluid_lbm/units.h"

#include <cmath>

#include "fluid_lbm/boundary/opening.h"
#include "fluid_lbm/boundary/refuse.h"
#include "fluid_lbm/obstacle/check_obstacles.h"

namespace magfsi::fluid {

namespace {

void check_positive(const char* name, double value, const char* unit) {
    if (!(value > 0) || !std::isfinite(value)) {
        refuse("fluid ", name, " is ", value, " ", unit, "; it must be above 0");
    }
}

void check_relaxation_time(const FluidConfig& config) {
    const double tau = relaxation_time(config);
    if (!(tau > 0.5) || !std::isfinite(tau)) {
        refuse("fluid relaxation time 3 nu dt / dx^2 + 1/2 is ", tau, " with viscosity ",
               config.viscosity_m2_s,
               " m2/s; it must be above 0.5: use a positive viscosity and a longer time "
               "step or finer spacing");
    }
}

void check_collision(const FluidConfig& config) {
    if (config.magic_number) check_positive("magic number", *config.magic_number, "");
    const double constant = config.smagorinsky_constant;
    if (!(constant >= 0 && constant <= 1)) {
        refuse("fluid Smagorinsky constant is ", constant,
               "; it must be between 0 and 1 (0.1 to 0.2 is usual)");
    }
}

}  // namespace

Units units(const FluidConfig& config) {
    return {config.spacing_m, config.time_step_s, config.density_kg_m3};
}

double relaxation_time(const FluidConfig& config) {
    return 3 * config.viscosity_m2_s * config.time_step_s /
               (config.spacing_m * config.spacing_m) +
           0.5;
}

void check(const FluidConfig& config) {
    for (int axis = 0; axis < 3; ++axis) {
        // Rows along x are walked in one piece; across them one cell is its own
        // neighbour.
        const bool periodic = config.boundaries[2 * axis].kind == BoundaryKind::periodic;
        const int least = axis > 0 && periodic ? 1 : 2;
        if (config.cells[axis] < least) {
            refuse("fluid has ", config.cells[axis], " cells along ", axis_name[axis],
                   "; it needs at least " + std::to_string(least));
        }
    }
    check_positive("spacing", config.spacing_m, "m");
    check_positive("time step", config.time_step_s, "s");
    check_positive("density", config.density_kg_m3, "kg/m3");
    check_relaxation_time(config);
    check_collision(config);
    check_boundaries(config);
    make_solids(config);
    if (config.body_force_n_m3) {
        for (double component : *config.body_force_n_m3) {
            if (!std::isfinite(component)) refuse("fluid body force is not finite");
        }
    }
}

}  // namespace magfsi::fluid
