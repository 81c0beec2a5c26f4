#include "fluid_lbm/initial_flow.h"

#include "fluid_lbm/lattice/equilibrium.h"
#include "fluid_lbm/units.h"

namespace magfsi::fluid {

namespace {

LocalFlow flow_at(const FluidConfig& config, const Vec3& centre_m) {
    const Units unit = units(config);
    LocalFlow flow;
    if (config.initial_pressure) {
        flow.density_excess = config.initial_pressure(centre_m) / unit.pressure_pa();
    }
    if (!config.initial_velocity) return flow;
    const Vec3 u = config.initial_velocity(centre_m);
    for (int a = 0; a < 3; ++a) flow.velocity[a] = u[a] / unit.velocity_m_s();
    for (int b = 0; b < 3; ++b) {
        Vec3 low = centre_m, high = centre_m;
        low[b] -= config.spacing_m / 2;
        high[b] += config.spacing_m / 2;
        const Vec3 u_low = config.initial_velocity(low);
        const Vec3 u_high = config.initial_velocity(high);
        for (int a = 0; a < 3; ++a) {
            flow.gradient[a][b] = (u_high[a] - u_low[a]) / unit.velocity_m_s();
        }
    }
    return flow;
}

template <class Real>
void set_populations(const FluidConfig& config, const Solver& solver,
                     const PopulationRows<Real>& rows) {
    const RowLayout& layout = solver.layout();
    const CellBox& box = solver.owned();
    const double tau = relaxation_time(config);
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            const int row = layout.row(y, z);
            for (int x = 0; x < layout.nx; ++x) {
                const LocalFlow flow =
                    flow_at(config, {(box.lo[0] + x + 0.5) * config.spacing_m,
                                     (box.lo[1] + y + 0.5) * config.spacing_m,
                                     (box.lo[2] + z + 0.5) * config.spacing_m});
                for (int q = 0; q < d3q19::directions; ++q) {
                    rows.row(q, row)[x] =
                        static_cast<Real>(flow_population(q, flow, tau));
                }
            }
        }
    }
}

}  // namespace

void set_initial_flow(const FluidConfig& config, const Solver& solver) {
    if (!config.initial_velocity && !config.initial_pressure) return;
    solver.populations().visit(
        [&](const auto& rows) { set_populations(config, solver, rows); });
}

}  // namespace magfsi::fluid
