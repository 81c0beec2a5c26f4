// SPDX-License-Identifier: GPL-2.0-or-later
// Populations that belong to a given flow, and the flow that belongs to given
// populations, for one cell at a time. Lattice units.
#pragma once

#include <array>

#include "base/vector/vec3.h"
#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid {

// Flow in one cell.
struct LocalFlow {
    double density_excess = 0;  // density - 1
    Vec3 velocity{};
    std::array<Vec3, 3> gradient{};  // [a][b] = d u_a / d x_b
};

// Density and velocity of a cell from its 19 populations minus their weights, without the
// half step of a force; the gradient stays zero.
template <class Populations>
LocalFlow flow_of(const Populations& f) {
    LocalFlow flow;
    for (int q = 0; q < d3q19::directions; ++q) {
        flow.density_excess += f[q];
        for (int a = 0; a < 3; ++a) flow.velocity[a] += d3q19::c[q][a] * f[q];
    }
    flow.velocity /= 1 + flow.density_excess;
    return flow;
}

// Second-order equilibrium of direction q as (f_eq - w_q) / w_q.
inline double equilibrium_over_weight(int q, const LocalFlow& flow) {
    double cu = 0, uu = 0;
    for (int a = 0; a < 3; ++a) {
        cu += d3q19::c[q][a] * flow.velocity[a];
        uu += flow.velocity[a] * flow.velocity[a];
    }
    return flow.density_excess +
           (1 + flow.density_excess) * (3 * cu + 4.5 * cu * cu - 1.5 * uu);
}

// Population of direction q minus its weight: equilibrium plus the non-equilibrium part
// that carries the viscous stress, - 3 w rho tau (c c - I / 3) : grad u. Without that
// part a run starts with a layer of wrong stress, which decays within a few steps but
// leaves an error of first order in the time step.
inline double flow_population(int q, const LocalFlow& flow, double relaxation_time) {
    double strain = 0;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double cc = d3q19::c[q][a] * d3q19::c[q][b] - (a == b ? d3q19::cs2 : 0);
            strain += cc * flow.gradient[a][b];
        }
    }
    const double density = 1 + flow.density_excess;
    return d3q19::weight(q) *
           (equilibrium_over_weight(q, flow) - 3 * density * relaxation_time * strain);
}

}  // namespace magfsi::fluid
