// SPDX-License-Identifier: GPL-2.0-or-later
// Distance of the wall that markers of forcing no_slip form from the markers themselves,
// at faces and rims (KernelReach).
#include <cmath>

#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/marker_surface.h"
#include "base/fitted/constants.h"
#include "fluid_lbm/collision/choice.h"

namespace magfsi::bodies {

namespace {

// The reach at a magic number [grid spacings]: linear in its logarithm between the known
// values, constant outside of them. The 4-point kernel has not been measured and takes
// the values of the 3-point one.
double edge(coupler::Kernel kernel, double magic_number) {
    const auto& known = fitted::known_edges;
    const auto of = [&](const fitted::EdgeAt& at) {
        return kernel == coupler::Kernel::two_point ? at.two_point : at.three_point;
    };
    for (std::size_t i = 1; i < known.size(); ++i) {
        const auto &low = known[i - 1], &high = known[i];
        if (magic_number > high.magic_number) continue;
        const double part = std::log(magic_number / low.magic_number) /
                            std::log(high.magic_number / low.magic_number);
        return std::lerp(of(low), of(high), std::max(part, 0.0));
    }
    return of(known.back());
}

}  // namespace

// Relaxation time and magic number are those of the grid at the bodies. Finite volumes
// have neither.
KernelReach reach_in(const scene::Scene& scene) {
    const coupler::Kernel kernel = scene.coupling->immersed_boundary.kernel;
    const double grid_m = scene.fluid->finest_spacing_m();
    if (scene.fluid->solver != scene::FluidSolver::lbm)
        return {grid_m, WallOfPlanes::of_finite_volumes(kernel),
                WallOfPlanes::of_finite_volumes(kernel, fitted::resolved_stokes_layer),
                fitted::edge_in_finite_volumes * grid_m};
    const double tau = scene::relaxation_time_at_bodies(scene).value_or(1);
    const double reynolds = fluid::cell_reynolds_number(
        *scene.fluid, scene.fluid->expected_speed_m_s, grid_m, tau);
    const bool moving_wall = fluid::has_moving_wall(*scene.fluid, grid_m, tau);
    const double magic =
        fluid::choose_magic_number(*scene.fluid, {tau, true, reynolds, moving_wall});
    return {grid_m, WallOfPlanes(kernel, tau, magic),
            WallOfPlanes(kernel, tau, magic, fitted::resolved_stokes_layer),
            edge(kernel, magic) * grid_m};
}

}  // namespace magfsi::bodies
