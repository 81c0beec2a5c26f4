// SPDX-License-Identifier: GPL-2.0-or-later
// How far outside of markers without slip their wall stands, at faces and rims.
#include <array>
#include <cmath>

#include "adapters/bodies/marker_surface.h"
#include "adapters/scene/effective.h"
#include "fluid_lbm/collision/choice.h"

namespace magfsi::bodies {

namespace {

// In grid spacings: with which plates and disks swung broadside have the exact added mass
// (tests/validation/no_slip), where their Stokes layer is 0.6, 0.9, 1.2 and 2.4
// spacings: grids on which the magic number is this (collision/choice.h). With the last
// a disk in a creeping stream errs as much broadside as edgewise. Not known for the
// 4-point kernel.
struct EdgeAt {
    double magic_number, two_point, three_point;
};
constexpr std::array<EdgeAt, 4> known_edges{
    {{0.005, 0.64, 0.99}, {0.01, 0.64, 0.93}, {0.016, 0.61, 0.90}, {0.03, 0.48, 0.75}}};

double edge(coupler::Kernel kernel, double magic_number) {
    const auto of = [&](const EdgeAt& at) {
        return kernel == coupler::Kernel::two_point ? at.two_point : at.three_point;
    };
    for (std::size_t i = 1; i < known_edges.size(); ++i) {
        const EdgeAt &low = known_edges[i - 1], &high = known_edges[i];
        if (magic_number > high.magic_number) continue;
        const double part = std::log(magic_number / low.magic_number) /
                            std::log(high.magic_number / low.magic_number);
        return std::lerp(of(low), of(high), std::max(part, 0.0));
    }
    return of(known_edges.back());
}

// In grid spacings: with which plates 2 to 4 spacings thick that swing broadside have the
// exact added mass (tests/validation/no_slip/plate.py).
constexpr double rim_of_two = 0.25;
double rim_of_more(coupler::Kernel kernel) {
    return kernel == coupler::Kernel::two_point ? 0.15 : 0;
}

// In grid spacings, where the inertia of one layer shall be exact: in flows that resolve
// it the force is then that of a wall (tests/validation/no_slip/sheet.py).
constexpr double resolved_stokes_layer = 4;

}  // namespace

KernelReach reach_in(const scene::Scene& scene) {
    const coupler::Kernel kernel = scene.coupling->immersed_boundary.kernel;
    const double grid_m = scene.fluid->finest_spacing_m();
    const double tau = scene::relaxation_time_at_bodies(scene).value_or(1);
    const double reynolds = fluid::cell_reynolds_number(
        *scene.fluid, scene.fluid->expected_speed_m_s, grid_m, tau);
    const double magic = fluid::choose_magic_number(*scene.fluid, {tau, true, reynolds});
    return {grid_m,
            WallOfPlanes(kernel, tau, magic),
            WallOfPlanes(kernel, tau, magic, resolved_stokes_layer),
            edge(kernel, magic) * grid_m,
            rim_of_two * grid_m,
            rim_of_more(kernel) * grid_m};
}

}  // namespace magfsi::bodies
