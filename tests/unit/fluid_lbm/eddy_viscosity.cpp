// Smagorinsky's relation: populations that carry the viscous stress of a known velocity
// gradient at the whole relaxation time give that time back,
//   tau = tau_0 + 3 C^2 |S|,  |S| = sqrt(2 S : S).
#include <gtest/gtest.h>

#include "fluid_lbm/lattice/equilibrium.h"
#include "tests/unit/fluid_lbm/reference_collision.h"

namespace magfsi::fluid {
namespace {

TEST(EddyViscosity, FollowsTheRateOfStrain) {
    constexpr double tau_0 = 0.503, constant = 0.17;
    LocalFlow flow;
    flow.density_excess = 0.01;
    flow.velocity = {0.05, -0.02, 0.03};
    // Free of divergence, as the relation's stress has no bulk part.
    flow.gradient = {{{0.02, 0.05, -0.01}, {0.01, -0.03, 0.04}, {-0.06, 0.02, 0.01}}};
    double squared = 0;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double s = 0.5 * (flow.gradient[a][b] + flow.gradient[b][a]);
            squared += 2 * s * s;
        }
    }
    const double tau = tau_0 + 3 * constant * constant * std::sqrt(squared);
    reference::Cell f;
    for (int q = 0; q < d3q19::directions; ++q) f[q] = flow_population(q, flow, tau);
    const double found = 1 / reference::eddy_rate(f, {}, 1 / tau_0, constant);
    EXPECT_NEAR(found, tau, 1e-14);  // a few roundings; tau - tau_0 is 0.007
    EXPECT_GT(tau - tau_0, 1e-3);
}

}  // namespace
}  // namespace magfsi::fluid
