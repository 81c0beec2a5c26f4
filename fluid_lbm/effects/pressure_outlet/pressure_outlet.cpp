#include "fluid_lbm/effects/pressure_outlet/pressure_outlet.h"

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

Flow flow_of(const double (&f)[directions]) {
    Flow flow;
    for (int q = 0; q < directions; ++q) {
        flow.excess += f[q];
        for (int a = 0; a < 3; ++a) flow.u[a] += c[q][a] * f[q];
    }
    for (double& u : flow.u) u /= 1 + flow.excess;
    return flow;
}

// Of a cell at the side, from its populations that do not enter there and the flow in the
// next cell inwards.
Flow flow_at_outlet(const double (&f)[directions], const Flow& inside, int axis,
                    int outward, double entering) {
    double known = 0;  // rho' + rho u_n
    for (int q = 0; q < directions; ++q) {
        const int out = c[q][axis] * outward;
        if (out >= 0) known += out > 0 ? 2 * f[q] : f[q];
    }
    // rho' + (1 + rho') u_n = known and cs2 rho' - cs u_n = entering: the smaller root.
    const double b = 0.5 * (cs2 + cs + entering), rest = cs2 * known - entering;
    const double u_n = rest / (b + std::sqrt(b * b + cs * rest));
    Flow flow = inside;
    flow.excess = (known - u_n) / (1 + u_n);
    flow.u[axis] = outward * u_n;
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

template <class Real>
void gather(const Real* base, const CellSlots& slots, double (&f)[directions]) {
    for (int q = 0; q < directions; ++q) f[q] = base[slots[q]];
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
            Cell inner = cells[i];
            inner[axis_] -= outward_;
            for (const Arrangement a : {Arrangement::natural, Arrangement::swapped}) {
                const int which = static_cast<int>(a);
                cells_[i].slots[which] = cell_slots(rows, layout, a, cells[i]);
                cells_[i].inner_slots[which] = cell_slots(rows, layout, a, inner);
            }
        }
    });
}

void PressureOutlet::look(const Populations& populations, Arrangement arrangement) {
    populations.visit([&](const auto& rows) {
        const auto* const base = rows.row(0, 0);
        for (OpenCell& cell : cells_) {
            const CellSlots& slots = cell.slots[static_cast<int>(arrangement)];
            double f[directions];
            gather(base, slots, f);
            const Flow flow = flow_of(f);
            const double pressure = cs2 * flow.excess, u_n = outward_ * flow.u[axis_];
            cell.entering = pressure - cs * u_n - pull_ * (pressure - target_pressure_);
        }
    });
}

void PressureOutlet::apply(const Populations& populations,
                           Arrangement arrangement) const {
    populations.visit([&](const auto& rows) {
        auto* base = rows.row(0, 0);
        for (const OpenCell& cell : cells_) {
            const int now = static_cast<int>(arrangement);
            const CellSlots& slots = cell.slots[now];
            double f[directions], inner[directions];
            gather(base, slots, f);
            gather(base, cell.inner_slots[now], inner);
            rebuild(f, axis_, outward_,
                    flow_at_outlet(f, flow_of(inner), axis_, outward_, cell.entering));
            for (int q = 0; q < directions; ++q) {
                base[slots[q]] = static_cast<std::decay_t<decltype(*base)>>(f[q]);
            }
        }
    });
}

}  // namespace magfsi::fluid
