// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/sampling/step_change.h"

#include <array>

#include "fluid_lbm/lattice/equilibrium.h"

namespace magfsi::fluid {

namespace {

using Stress = std::array<Vec3, 3>;

// Second moment of a cell's populations beyond its equilibrium.
Stress stress_of(std::span<const double> f, const LocalFlow& flow) {
    Stress stress{};
    for (int q = 0; q < d3q19::directions; ++q) {
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b)
                stress[a][b] += d3q19::c[q][a] * d3q19::c[q][b] * f[q];
        }
    }
    const double density = 1 + flow.density_excess;
    for (int a = 0; a < 3; ++a) {
        stress[a][a] -= d3q19::cs2 * flow.density_excess;
        for (int b = 0; b < 3; ++b)
            stress[a][b] -= density * flow.velocity[a] * flow.velocity[b];
    }
    return stress;
}

// Populations of a flow and a stress, w [excess + 3 rho c.u + 4.5 (c c - I/3) : (rho u u
// + stress)].
void rebuild(const LocalFlow& flow, const Stress& stress, std::span<double> f) {
    const double density = 1 + flow.density_excess;
    for (int q = 0; q < d3q19::directions; ++q) {
        double sum = flow.density_excess;
        for (int a = 0; a < 3; ++a) {
            sum += 3 * density * d3q19::c[q][a] * flow.velocity[a];
            for (int b = 0; b < 3; ++b) {
                const double cc =
                    d3q19::c[q][a] * d3q19::c[q][b] - (a == b ? d3q19::cs2 : 0);
                const double flux =
                    density * flow.velocity[a] * flow.velocity[b] + stress[a][b];
                sum += 4.5 * cc * flux;
            }
        }
        f[q] = d3q19::weight(q) * sum;
    }
}

}  // namespace

StepChange step_change(const FluidConfig& config, double old_step_s) {
    FluidConfig before = config;
    before.time_step_s = old_step_s;
    StepChange change;
    change.velocity = config.time_step_s / old_step_s;
    change.stress = relaxation_time(config) / relaxation_time(before) * change.velocity;
    if (config.bulk_viscosity_m2_s)
        change.trace = *trace_relaxation_time(config) / *trace_relaxation_time(before) *
                       change.velocity / change.stress;
    if (!config.body_force_n_m3) return change;
    change.momentum = half_body_force(config) * (1 / change.velocity - 1);
    return change;
}

void change_step(const StepChange& change, std::span<double> values) {
    constexpr std::size_t width = d3q19::directions;
    for (std::size_t cell = 0; cell + width <= values.size(); cell += width) {
        const std::span<double> f = values.subspan(cell, width);
        LocalFlow flow = flow_of(f);
        Stress stress = stress_of(f, flow);
        const double before = 1 + flow.density_excess;
        flow.density_excess *= change.velocity * change.velocity;
        const double denser = (1 + flow.density_excess) / before;
        for (int a = 0; a < 3; ++a) {
            flow.velocity[a] = flow.velocity[a] * change.velocity +
                               change.momentum[a] / (1 + flow.density_excess);
            for (int b = 0; b < 3; ++b) stress[a][b] *= denser * change.stress;
        }
        if (change.trace != 1) {
            const double more =
                (change.trace - 1) / 3 * (stress[0][0] + stress[1][1] + stress[2][2]);
            for (std::size_t a = 0; a < 3; ++a) stress[a][a] += more;
        }
        rebuild(flow, stress, f);
    }
}

}  // namespace magfsi::fluid
