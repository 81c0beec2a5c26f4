// SPDX-License-Identifier: GPL-2.0-or-later
// Distance of the wall that markers of forcing no_slip form from the markers themselves,
// at faces and rims (KernelReach). All constants here are in grid spacings.
#include <array>
#include <cmath>

#include "adapters/bodies/marker_surface.h"
#include "adapters/scene/effective.h"
#include "fluid_lbm/collision/choice.h"

namespace magfsi::bodies {

namespace {

// Reach of a single layer beyond the edge of its markers, for the 2-point and the 3-point
// kernel, by the magic number of the grid (collision/choice.h). Fitted: with these values
// plates and disks that oscillate broadside have the exact added mass where their Stokes
// layer is 0.6, 0.9, 1.2 and 2.4 spacings (tests/validation/no_slip). With the last value
// a disk in a creeping stream has equal errors broadside and edgewise. The 4-point kernel
// has not been measured and takes the values of the 3-point one.
struct EdgeAt {
    double magic_number, two_point, three_point;
};
constexpr std::array<EdgeAt, 4> known_edges{
    {{0.005, 0.64, 0.99}, {0.01, 0.64, 0.93}, {0.016, 0.61, 0.90}, {0.03, 0.48, 0.75}}};

// The reach at a magic number: linear in its logarithm between the known values, constant
// outside of them.
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

// Additional depth of the rows along the rim of sheets of two and of more layers. Fitted:
// with these values plates 2 to 4 spacings thick that oscillate broadside have the exact
// added mass (tests/validation/no_slip/plate.py).
constexpr double rim_of_two = 0.25;
double rim_of_more(coupler::Kernel kernel) {
    return kernel == coupler::Kernel::two_point ? 0.15 : 0;
}

// Stokes layer at which the inertia of a single layer is made exact: in flows that
// resolve this layer the force is then that of a wall
// (tests/validation/no_slip/sheet.py).
constexpr double resolved_stokes_layer = 4;

}  // namespace

// Relaxation time and magic number are those of the grid at the bodies; a fluid without a
// relaxation time counts with 1.
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
