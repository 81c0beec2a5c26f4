// SPDX-License-Identifier: GPL-2.0-or-later
// Kernel for Kelvin-Voigt forces in Hadamard mode space, `width` elements at a time;
// viscous_element is the same in plain form.
#include "structure/lattice/motion_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Stress of the mean F: an eighth of V0 P, with the sign of minus the forces. Returns an
// eighth of the dissipation.
MAGFSI_INLINE Real mean_part(const Real& eighth, double eta, const Motion& x,
                             const Motion& v, Vec (&stress)[3]) {
    Real rate[3][3];  // Edot
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            rate[i][j] = 0.5 * (dot(x.f[i], v.f[j]) + dot(x.f[j], v.f[i]));
            rate[j][i] = rate[i][j];
        }
    }
    const Real scale = (2 * eta) * eighth;
    Real sum = {};
    for (int j = 0; j < 3; ++j) {
        stress[j] = {Real{}, Real{}, Real{}};
        for (int i = 0; i < 3; ++i) {
            stress[j] = stress[j] + rate[i][j] * x.f[i];
            sum += rate[i][j] * rate[i][j];
        }
        stress[j] = scale * stress[j];
    }
    return scale * sum;
}

// Damping of the mode xyz: adds to the edge modes of g and stores minus the force on the
// vector in w. Returns an eighth of the dissipation.
template <bool brick>
MAGFSI_INLINE Real last_part(const Real& eighth, double eta, const double* metric,
                             const Motion& x, const Motion& v, Vec (&g)[8], Vec& w) {
    Real p[3];
    for (int d = 0; d < 3; ++d) {
        constexpr int entry[3] = {3, 0, 1};
        p[d] = load(metric + (brick ? d : entry[d]) * batch_lanes);
    }
    Real smallest = p[0] < p[1] ? p[0] : p[1];
    smallest = smallest < p[2] ? smallest : p[2];
    const Real scale = (eta / 3) * eighth * smallest;
    Real sum = {};
    w = {Real{}, Real{}, Real{}};
    for (int d = 0; d < 3; ++d) {
        const int m = 1 << d;
        const Real rate = dot(v.mode[m], x.last[0]) + dot(x.mode[m], v.last[0]);
        const Real stress = scale * p[d] * rate;
        g[m] = g[m] + stress * x.last[0];
        w = w + stress * x.mode[m];
        sum += stress * rate;
    }
    return sum;
}

// One batch: takes positions in x and velocities in v and leaves the forces in x.mode;
// returns the dissipation.
template <bool brick>
MAGFSI_INLINE Real element(const ViscousBatches& b, const double* data, Motion& x,
                           Motion& v) {
    complete<brick>(data, x);
    complete<brick>(data, v);
    const Real v0 = load(data);
    const Real eighth = 0.125 * v0;
    const double* gradient = data + batch_lanes;
    const double* metric = data + (brick ? 4 : 22) * batch_lanes;
    Vec stress[3];
    Real dissipation = mean_part(eighth, b.viscosity_pa_s, x, v, stress);
    Vec g[8] = {};
    const Planes rate = hourglass_strain(v.mode, x.v) + hourglass_strain(x.mode, v.v);
    const Planes planes = hourglass_stress<brick>(
        hourglass_moduli(b.viscosity_pa_s, b.plate_lambda_pa_s, v0), metric, rate);
    Vec w[3];
    hourglass_forces(planes, x.mode, x.v, g, w);
    dissipation += dot(planes, rate);
    Vec last[1];
    dissipation += last_part<brick>(eighth, b.viscosity_pa_s, metric, x, v, g, last[0]);
    g[3] = w[0];
    g[5] = w[1];
    g[6] = w[2];
    g[7] = last[0];
    if constexpr (brick) {
        for (int d = 0; d < 3; ++d) {
            g[1 << d] = g[1 << d] + load(gradient + d * batch_lanes) * stress[d];
        }
    } else {
        return_linear(data + 31 * batch_lanes, w, stress);
        return_linear(data + 40 * batch_lanes, last, stress);
        add_stress(gradient, stress, g);
    }
    x.mode[0] = {Real{}, Real{}, Real{}};
    for (int m = 1; m < 8; ++m) x.mode[m] = splat(-1.0) * g[m];
    to_nodes(x.mode);
    return 8.0 * dissipation;
}

// All batches in order. Lanes past the last element add nothing.
template <bool brick>
double run(const ViscousBatches& b, const double* x, const double* v, double* f) {
    double sum = 0;
    const long batches = (b.element_count + batch_lanes - 1) / batch_lanes;
    for (long batch = 0; batch < batches; ++batch) {
        const int filled = b.element_count - static_cast<int>(batch) * batch_lanes;
        for (int lane = 0; lane < batch_lanes && lane < filled; lane += width) {
            const int* node = b.node + batch * 8 * batch_lanes + lane;
            const double* data =
                b.data + batch * viscous_entries(brick) * batch_lanes + lane;
            Motion position, velocity;
            for (int a = 0; a < 8; ++a) {
                position.mode[a] = gather_node(x, node + a * batch_lanes);
                velocity.mode[a] = gather_node(v, node + a * batch_lanes);
            }
            const Real dissipation = element<brick>(b, data, position, velocity);
            const int left = filled - lane;
            const int count = left < width ? left : width;
            for (int a = 0; a < 8; ++a) {
                scatter_node(f, node + a * batch_lanes, position.mode[a], count);
            }
            for (int l = 0; l < count; ++l) sum += dissipation[l];
        }
    }
    return sum;
}

}  // namespace

double run_viscous(const ViscousBatches& b, const double* x, const double* v, double* f) {
    return b.bricks ? run<true>(b, x, v, f) : run<false>(b, x, v, f);
}

}  // namespace magfsi::structure::MAGFSI_ISA
