// Populations to start from.
#pragma once

#include <array>

namespace magfsi::fluid {

// Lattice units. gradient[a][b] = d u_a / d x_b.
struct LocalFlow {
    double density_excess = 0;  // density - 1
    std::array<double, 3> velocity{};
    std::array<std::array<double, 3>, 3> gradient{};
};

// f_q - w_q of direction q: second-order equilibrium plus the non-equilibrium part that
// carries the viscous stress, - 3 w rho tau (c c - I / 3) : grad u. Without the latter a
// run starts with a layer of wrong stress that decays within a few steps but leaves an
// error of first order in the time step.
double flow_population(int q, const LocalFlow& flow, double relaxation_time);

}  // namespace magfsi::fluid
