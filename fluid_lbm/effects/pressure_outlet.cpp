// SPDX-License-Identifier: GPL-2.0-or-later
// Sides that let flow and sound out. In one dimension the flow carries two
// characteristics: p + cs u_n leaves with the populations that stream to the side, and p
// - cs u_n enters. The entering one is kept constant except for a slow pull of the
// pressure to its target (Poinsot and Lele 1992; u_n along the outward normal, rho0 = 1):
//   (p - cs u_n)(t + 1) = (p - cs u_n)(t) - k (p(t) - p_target),  k = 0.25 cs / L.
// A fixed pressure would reflect sound fully, and so would a fixed velocity. The
// populations that have streamed to a cell give rho + rho u_n exactly (Zou and He 1997),
// and pressure and velocity follow from both. Fluid that enters here has no tangential
// velocity: a velocity that is taken from inside and carried in again would grow.
#include <cmath>

#include "base/fitted/constants.h"
#include "fluid_lbm/boundary/outflow.h"

namespace magfsi::fluid {

namespace {

using namespace d3q19;

const double cs = std::sqrt(cs2);

// Flow of a cell at the side, from its populations that do not enter there, the flow in
// the next cell inwards, and the entering characteristic.
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
    LocalFlow flow;
    if (u_n > 0) flow = inside;
    flow.density_excess = (known - u_n) / (1 + u_n);
    flow.velocity[axis] = outward * u_n;
    return flow;
}

// This rank's open cells of fluid at a side, in local indices.
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

// The outlet at one side.
class PressureOutlet final : public SideEffect {
  public:
    PressureOutlet(const SideContext& in, int side, const CellBox& side_cells);
    void before_sweep(const Populations& populations, Arrangement arrangement) override;
    void end_step(const Populations& populations, Arrangement arrangement) override;

  private:
    int axis_, outward_;
    double target_pressure_, pull_;  // lattice units; k
    std::vector<OutflowCell> cells_;
    std::vector<double> entering_;  // p - cs u_n of each cell
};

PressureOutlet::PressureOutlet(const SideContext& in, int side, const CellBox& side_cells)
    : axis_(axis_of(side)),
      outward_(-inward(side)),
      target_pressure_(cs2 * (in.config.boundaries[side].outlet_pressure_pa /
                              units(in.config).pressure_pa())),
      pull_(fitted::pull_strength * cs / in.config.cells[axis_]),
      cells_(outflow_cells(in, side, open_cells(in, side, side_cells))),
      entering_(cells_.size()) {}

void PressureOutlet::before_sweep(const Populations& populations,
                                  Arrangement arrangement) {
    populations.visit([&](const auto& rows) {
        const auto* const base = rows.row(0, 0);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            double f[directions];
            gather(base, cells_[i].slots[static_cast<int>(arrangement)], f);
            const LocalFlow flow = flow_of(f);
            const double pressure = cs2 * flow.density_excess,
                         u_n = outward_ * flow.velocity[axis_];
            entering_[i] = pressure - cs * u_n - pull_ * (pressure - target_pressure_);
        }
    });
}

// Rebuilds the cells after all other effects have been applied to them.
void PressureOutlet::end_step(const Populations& populations, Arrangement arrangement) {
    populations.visit([&](const auto& rows) {
        auto* base = rows.row(0, 0);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const auto now = static_cast<int>(arrangement);
            double f[directions], inner[directions];
            gather(base, cells_[i].slots[now], f);
            gather(base, cells_[i].inner_slots[now], inner);
            rebuild(f, axis_, outward_,
                    flow_at_outlet(f, flow_of(inner), axis_, outward_, entering_[i]));
            scatter(f, cells_[i].slots[now], base);
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
