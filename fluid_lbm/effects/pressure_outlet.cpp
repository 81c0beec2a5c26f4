// SPDX-License-Identifier: GPL-2.0-or-later
// Sides that let flow and sound out. In one dimension the flow carries two
// characteristics; p + cs u_n leaves with what streams to the side, p - cs u_n enters.
// The entering one is kept constant but for a slow pull of the pressure to its target
// (Poinsot and Lele 1992; u_n along the outward normal, rho0 = 1):
//   (p - cs u_n)(t + 1) = (p - cs u_n)(t) - k (p(t) - p_target),  k = 0.25 cs / L.
// A fixed pressure would reflect sound fully, a fixed velocity too. The populations that
// have streamed to a cell know rho + rho u_n exactly (Zou and He 1997): both follow. All
// 19 are then rebuilt from rho, u and the stress, with the bounce-back of the
// non-equilibrium part for the unknown ones (regularised: Latt et al. 2008), which stays
// stable close to relaxation time 1/2. The tangential velocity is that of the next cell
// inwards.
#include <cmath>

#include "fluid_lbm/boundary/boundaries.h"
#include "fluid_lbm/lattice/equilibrium.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

using namespace d3q19;

const double cs = std::sqrt(cs2);
// Fraction of the textbook's largest useful value (0.1 to 0.58): sound of a wave length
// of L reflects by a few per cent, and the mean pressure settles in about 4 L / cs steps.
constexpr double pull_strength = 0.25;

// Of a cell at the side, from its populations that do not enter there and the flow in the
// next cell inwards.
LocalFlow flow_at_outlet(const double (&f)[directions], const LocalFlow& inside, int axis,
                         int outward, double entering) {
    double known = 0;  // rho' + rho u_n
    for (int q = 0; q < directions; ++q) {
        const int out = c[q][axis] * outward;
        if (out >= 0) known += out > 0 ? 2 * f[q] : f[q];
    }
    // rho' + (1 + rho') u_n = known and cs2 rho' - cs u_n = entering: the smaller root.
    const double b = 0.5 * (cs2 + cs + entering), rest = cs2 * known - entering;
    const double u_n = rest / (b + std::sqrt(b * b + cs * rest));
    LocalFlow flow = inside;
    flow.density_excess = (known - u_n) / (1 + u_n);
    flow.velocity[axis] = outward * u_n;
    return flow;
}

void rebuild(double (&f)[directions], int axis, int outward, const LocalFlow& flow) {
    double balance[directions], stress[3][3] = {};
    for (int q = 0; q < directions; ++q) {
        balance[q] = weight(q) * equilibrium_over_weight(q, flow);
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

// An outlet reads the cell inside of each of its own.
void check_depth(const Decomposition& decomposition, int side) {
    const int axis = axis_of(side);
    for (const CellBox& box : decomposition.boxes) {
        if (box.hi[axis] - box.lo[axis] > 1) continue;
        refuse("fluid box is cut into parts of one cell along ", axis_name[axis],
               ", and the pressure outlet at ", side_name[side],
               " needs two; choose fewer fluid ranks");
    }
}

// This rank's, local indices.
std::vector<Cell> open_cells(const SideContext& in, int side, const CellBox& side_cells) {
    std::vector<Cell> cells;
    for_each_cell(side_cells, [&](const Cell& cell) {
        const auto& first = in.owned().lo;
        const Cell global{cell[0] + first[0], cell[1] + first[1], cell[2] + first[2]};
        const bool solid = in.solids && in.solids->solid(cell);
        if (!solid && is_open(in.config, side, global)) cells.push_back(cell);
    });
    return cells;
}

class PressureOutlet final : public SideEffect {
  public:
    PressureOutlet(const SideContext& in, int side, const CellBox& side_cells);
    void before_sweep(const Populations& populations, Arrangement arrangement) override;
    void end_step(const Populations& populations, Arrangement arrangement) override;

  private:
    struct OpenCell {
        CellSlots slots[2], inner_slots[2];  // by arrangement
        double entering = 0;                 // p - cs u_n
    };

    int axis_, outward_;
    double target_pressure_, pull_;
    std::vector<OpenCell> cells_;
};

PressureOutlet::PressureOutlet(const SideContext& in, int side, const CellBox& side_cells)
    : axis_(axis_of(side)),
      outward_(-inward(side)),
      target_pressure_(cs2 * (in.config.boundaries[side].outlet_pressure_pa /
                              units(in.config).pressure_pa())),
      pull_(pull_strength * cs / in.config.cells[axis_]) {
    const std::vector<Cell> cells = open_cells(in, side, side_cells);
    cells_.resize(cells.size());
    in.populations.visit([&](const auto& rows) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            Cell inner = cells[i];
            inner[axis_] -= outward_;
            for (const Arrangement a : {Arrangement::natural, Arrangement::swapped}) {
                const int which = static_cast<int>(a);
                cells_[i].slots[which] = cell_slots(rows, in.layout, a, cells[i]);
                cells_[i].inner_slots[which] = cell_slots(rows, in.layout, a, inner);
            }
        }
    });
}

void PressureOutlet::before_sweep(const Populations& populations,
                                  Arrangement arrangement) {
    populations.visit([&](const auto& rows) {
        const auto* const base = rows.row(0, 0);
        for (OpenCell& cell : cells_) {
            const CellSlots& slots = cell.slots[static_cast<int>(arrangement)];
            double f[directions];
            gather(base, slots, f);
            const LocalFlow flow = flow_of(f);
            const double pressure = cs2 * flow.density_excess,
                         u_n = outward_ * flow.velocity[axis_];
            cell.entering = pressure - cs * u_n - pull_ * (pressure - target_pressure_);
        }
    });
}

// After all else has been applied to the cells.
void PressureOutlet::end_step(const Populations& populations, Arrangement arrangement) {
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

}  // namespace

std::unique_ptr<SideEffect> make_pressure_outlet_effect(const SideContext& in, int side) {
    check_depth(in.decomposition, side);
    const auto cells = in.cells_at(side);
    return cells ? std::make_unique<PressureOutlet>(in, side, *cells) : nullptr;
}

}  // namespace magfsi::fluid
