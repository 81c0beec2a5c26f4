// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/interlevel.h"

#include <cmath>

namespace magfsi::fluid {

Weights cubic_at(double at, int lo, int hi) {
    Weights w;
    w.first = static_cast<int>(std::floor(at)) - 1;
    if (w.first > hi - cubic_points) w.first = hi - cubic_points;
    if (w.first < lo) w.first = lo;
    const double t = at - w.first;
    for (int i = 0; i < cubic_points; ++i) {
        double product = 1;
        for (int j = 0; j < cubic_points; ++j)
            if (j != i) product *= (t - j) / (i - j);
        w.of[i] = product;
    }
    return w;
}

Scales to_fine(const Level& coarse, const Level& fine) {
    const FluidConfig& c = coarse.fluid.config();
    const FluidConfig& f = fine.fluid.config();
    Scales scales{relaxation_time(f) / (2 * relaxation_time(c)), 1, {}};
    if (c.bulk_viscosity_m2_s)
        scales.trace =
            *trace_relaxation_time(f) / (2 * *trace_relaxation_time(c)) / scales.stress;
    if (!c.body_force_n_m3) return scales;
    scales.velocity =
        *c.body_force_n_m3 * (1 / units(c).force_n_m3() - 1 / units(f).force_n_m3()) / 2;
    return scales;
}

void apply(const Scales& scales, double sign, double* flow, std::size_t count) {
    const double factor = sign > 0 ? scales.stress : 1 / scales.stress;
    for (std::size_t a = 0; a < 3; ++a) {
        if (scales.velocity[a] == 0) continue;
        double* u = flow + (1 + a) * count;
        for (std::size_t i = 0; i < count; ++i) u[i] += sign * scales.velocity[a];
    }
    double* stress = flow + first_stress * count;
    for (std::size_t i = 0; i < (numbers_between_levels - first_stress) * count; ++i)
        stress[i] *= factor;
    if (scales.trace != 1)
        scale_trace(sign > 0 ? scales.trace : 1 / scales.trace, stress, count);
}

void scale_trace(double factor, double* stress, std::size_t count) {
    double* const xx = stress;
    double* const yy = xx + count;
    double* const zz = yy + count;
    for (std::size_t i = 0; i < count; ++i) {
        const double more = (factor - 1) / 3 * (xx[i] + yy[i] + zz[i]);
        xx[i] += more;
        yy[i] += more;
        zz[i] += more;
    }
}

}  // namespace magfsi::fluid
