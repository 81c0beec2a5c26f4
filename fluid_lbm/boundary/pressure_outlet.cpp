#include "fluid_lbm/boundary/pressure_outlet.h"

#include <cmath>

namespace magfsi::fluid {

namespace {

using namespace d3q19;

const double cs = std::sqrt(cs2);
// Fraction of the textbook's largest useful value (0.1 to 0.58): sound of a wave length
// of L reflects by a few per cent, and the mean pressure settles in about 4 L / cs steps.
constexpr double pull_strength = 0.25;

struct Flow {
    double excess = 0;  // density - 1
    double u[3] = {};
};

double equilibrium(int q, const Flow& flow) {
    double cu = 0, uu = 0;
    for (int a = 0; a < 3; ++a) {
        cu += c[q][a] * flow.u[a];
        uu += flow.u[a] * flow.u[a];
    }
    return weight(q) *
           (flow.excess + (1 + flow.excess) * (3 * cu + 4.5 * cu * cu - 1.5 * uu));
}

// Density and velocity of a cell from the populations that do not enter by the side.
Flow flow_at_outlet(const double (&f)[directions], int axis, int outward,
                    double entering) {
    double known = 0, along[3] = {};  // rho' + j_n; tangential momentum
    for (int q = 0; q < directions; ++q) {
        const int out = c[q][axis] * outward;
        if (out < 0) continue;
        known += out > 0 ? 2 * f[q] : f[q];
        for (int a = 0; a < 3; ++a) along[a] += c[q][a] * f[q];
    }
    Flow flow;
    const double j_n = (cs2 * known - entering) / (cs2 + cs);
    flow.excess = known - j_n;
    const double density = 1 + flow.excess, u_n = j_n / density;
    for (int a = 0; a < 3; ++a) {
        // At equilibrium the known populations carry rho u_t (2/3 + 1/6 + u_n / 2).
        flow.u[a] =
            a == axis ? outward * u_n : along[a] / (density * (5.0 / 6 + 0.5 * u_n));
    }
    return flow;
}

void rebuild(double (&f)[directions], int axis, int outward, const Flow& flow) {
    double balance[directions], stress[3][3] = {};
    for (int q = 0; q < directions; ++q) {
        balance[q] = equilibrium(q, flow);
        if (c[q][axis] * outward < 0) continue;
        // Those that enter: f - f_eq as of the opposite, which has the same c c.
        const double both = c[q][axis] == 0 ? 1 : 2;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                stress[a][b] += both * c[q][a] * c[q][b] * (f[q] - balance[q]);
            }
        }
    }
    for (int q = 0; q < directions; ++q) {
        double off = 0;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                off += (c[q][a] * c[q][b] - (a == b ? cs2 : 0)) * stress[a][b];
            }
        }
        f[q] = balance[q] + 4.5 * weight(q) * off;
    }
}

}  // namespace

PressureOutlet::PressureOutlet(const LatticeSide& side, int side_index,
                               const std::vector<Cell>& cells, int length,
                               const Populations& populations, const RowLayout& layout)
    : axis_(axis_of(side_index)),
      outward_(-inward(side_index)),
      target_pressure_(cs2 * side.density_excess),
      pull_(pull_strength * cs / length) {
    cells_.resize(cells.size());
    populations.visit([&](const auto& rows) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            for (const Arrangement a : {Arrangement::natural, Arrangement::swapped}) {
                cells_[i].slots[static_cast<int>(a)] =
                    cell_slots(rows, layout, a, cells[i]);
            }
        }
    });
}

void PressureOutlet::look(const Populations& populations, Arrangement arrangement) {
    populations.visit([&](const auto& rows) {
        const auto* base = rows.row(0, 0);
        for (OpenCell& cell : cells_) {
            const CellSlots& slots = cell.slots[static_cast<int>(arrangement)];
            double excess = 0, j_n = 0;
            for (int q = 0; q < directions; ++q) {
                const double f = base[slots[q]];
                excess += f;
                j_n += outward_ * c[q][axis_] * f;
            }
            const double pressure = cs2 * excess;
            cell.entering = pressure - cs * j_n - pull_ * (pressure - target_pressure_);
        }
    });
}

void PressureOutlet::apply(const Populations& populations,
                           Arrangement arrangement) const {
    populations.visit([&](const auto& rows) {
        auto* base = rows.row(0, 0);
        for (const OpenCell& cell : cells_) {
            const CellSlots& slots = cell.slots[static_cast<int>(arrangement)];
            double f[directions];
            for (int q = 0; q < directions; ++q) f[q] = base[slots[q]];
            rebuild(f, axis_, outward_,
                    flow_at_outlet(f, axis_, outward_, cell.entering));
            for (int q = 0; q < directions; ++q) {
                base[slots[q]] = static_cast<std::decay_t<decltype(*base)>>(f[q]);
            }
        }
    });
}

}  // namespace magfsi::fluid
