#include "fluid_lbm/sampling/plane_flow.h"

#include <algorithm>
#include <cmath>

namespace magfsi::fluid {

namespace {

// Sums over cells, each by the weight of its layer, lattice units.
enum { flow, momentum, excess = momentum + 3, cells, sums };

struct Layers {
    int axis, low;  // global index of the lower of the two
    double upper;   // weight of the upper
    double weight(int index) const {
        return index == low ? 1 - upper : index == low + 1 ? upper : 0;
    }
};

Layers layers_at(int axis, double at_cells, int count) {
    const double centred = std::clamp(at_cells - 0.5, 0.0, count - 1.0);
    const int low = std::min(static_cast<int>(centred), std::max(0, count - 2));
    return {axis, low, centred - low};
}

void add_cell(const RowMoments& m, std::size_t i, const Layers& layers, double weight,
              double* sum) {
    const double density = 1 + m.excess[i];
    const double through = m.j[static_cast<std::size_t>(layers.axis)][i] / density;
    sum[flow] += weight * through;
    for (std::size_t a = 0; a < 3; ++a) sum[momentum + a] += weight * through * m.j[a][i];
    sum[excess] += weight * m.excess[i];
    sum[cells] += weight;
}

// The cells of the two layers; Solid: some may be an obstacle's.
template <bool Solid>
void add_layers(const Solver& solver, const Layers& layers, double* sum) {
    const RowLayout& layout = solver.layout();
    const CellBox& box = solver.owned();
    const bool across_rows = layers.axis == 0;
    const int begin = across_rows ? layers.low : 0;
    const int end = across_rows ? std::min(layers.low + 2, layout.nx) : layout.nx;
    RowMoments m;
    for (int z = 0; z < layout.nz; ++z) {
        for (int y = 0; y < layout.ny; ++y) {
            const double of_row =
                layers.weight(layers.axis == 1 ? box.lo[1] + y : box.lo[2] + z);
            if (!across_rows && of_row == 0) continue;
            row_moments(solver.view(), y, z, begin, end, m);
            for (int x = begin; x < end; ++x) {
                if constexpr (Solid) {
                    if (solver.is_solid({x, y, z})) continue;
                }
                add_cell(m, static_cast<std::size_t>(x - begin), layers,
                         across_rows ? layers.weight(x) : of_row, sum);
            }
        }
    }
}

}  // namespace

PlaneFlow plane_flow(MPI_Comm comm, const Solver& solver, const Units& unit, int axis,
                     double at_cells) {
    const Layers layers = layers_at(
        axis, at_cells, solver.decomposition().cells[static_cast<std::size_t>(axis)]);
    double sum[sums] = {};
    if (solver.obstacles())
        add_layers<true>(solver, layers, sum);
    else
        add_layers<false>(solver, layers, sum);
    MPI_Allreduce(MPI_IN_PLACE, sum, sums, MPI_DOUBLE, MPI_SUM, comm);

    const double area = unit.spacing_m * unit.spacing_m, speed = unit.velocity_m_s();
    PlaneFlow out;
    out.flow_m3_s = sum[flow] * speed * area;
    for (std::size_t a = 0; a < 3; ++a)
        out.momentum_flux_n[a] =
            sum[momentum + a] * unit.density_kg_m3 * speed * speed * area;
    out.pressure_pa = sum[cells] > 0 ? sum[excess] / sum[cells] * unit.pressure_pa() : 0;
    return out;
}

}  // namespace magfsi::fluid
