// SPDX-License-Identifier: GPL-2.0-or-later
// Sides with a prescribed velocity: half-way bounce-back adds 6 w rho0 c.u to each
// population that enters (Ladd 1994), rho0 = 1. The sum over a face is rho0 u.n exactly:
// the mass flux is the prescribed one. Where a side meets a moving wall, the links
// through the edge are the inlet's. Where the flow leaves by a face, its tangential
// velocity is that of the next cell inwards instead of the prescribed one (outflow.h).
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "fluid_lbm/boundary/outflow.h"

namespace magfsi::fluid {

namespace {

using namespace d3q19;

class VelocityInlet final : public SideEffect {
  public:
    // scale: factor of the configured velocity.
    VelocityInlet(const SideContext& in, int side, const CellBox& side_cells,
                  double scale);

    void after_exchange(const Populations& populations, const RowLayout& layout,
                        double time) override {
        factor_ =
            time >= ramp_ ? 1 : 0.5 * (1 - std::cos(std::numbers::pi * time / ramp_));
        if (course_) factor_ *= course_(time * step_s_);
        populations.visit([&](const auto& rows) { add(rows, layout, factor_); });
    }

    void end_step(const Populations& populations, Arrangement arrangement) override {
        if (leaving_.empty()) return;
        populations.visit([&](const auto& rows) {
            let_out(rows.row(0, 0), static_cast<int>(arrangement));
        });
    }

  private:
    // Index into velocity_ and open_.
    int index(const Cell& local) const {
        const int i = local[in_plane_[0]] - cells_.lo[in_plane_[0]] + 1;
        const int j = local[in_plane_[1]] - cells_.lo[in_plane_[1]] + 1;
        return j * stride_ + i;
    }
    Vec3 slope(const Cell& local, int axis) const;
    template <class Real>
    void add(const PopulationRows<Real>& rows, const RowLayout& layout,
             double factor) const;
    template <class Real>
    void let_out(Real* base, int arrangement) const;

    int side_;
    CellBox cells_;                // this rank's cells at the side, in local indices
    std::array<int, 2> in_plane_;  // the axes in the side's plane
    int stride_;
    double ramp_;  // length of the ramp in steps
    double step_s_;
    std::function<double(double)> course_;
    // Velocity [cells per step] and opening, with a margin of one cell around the rank's
    // part of the side; first in-plane axis fastest, rows of stride_ values.
    std::vector<Vec3> velocity_;
    std::vector<char> open_;
    std::vector<Cell> open_cells_;  // this rank's, in local indices
    double factor_ = 0;             // factor of the velocity in this step
    // Fluid cells by which flow leaves at some time (local indices), and their slots.
    std::vector<Cell> leaving_cells_;
    std::vector<OutflowCell> leaving_;
};

// True if flow may leave by an inlet's side: a course over time may reverse it.
bool may_leave(const FluidConfig& config, int side) {
    return config.boundaries[side].inlet.factor || inflow_m3_s(config, side) < 0;
}

// Global indices of a cell, wrapped around periodic axes.
Cell global(const SideContext& in, const Cell& local) {
    Cell cell;
    for (int a = 0; a < 3; ++a) {
        const int count = in.config.cells[a];
        cell[a] = in.owned().lo[a] + local[a];
        if (in.decomposition.periodic[a]) cell[a] = (cell[a] + count) % count;
    }
    return cell;
}

// Factor by which the other cells take over the flow of those at the rim of an opening
// whose centre lies beyond it and in an obstacle, as where a tube begins: without it up
// to 5 % of the flow is lost in a tube of 8 cells. Each rank knows its own cells; the sum
// runs in the same order on any ranks. Collective.
double scale_at_rim(const SideContext& in, int side) {
    const FluidConfig& config = in.config;
    if (!config.boundaries[side].patch || !in.solids) return 1;
    const auto [first, second] = in_plane(side);
    const auto index = [&](const Cell& cell) {
        return static_cast<std::size_t>(cell[second]) * config.cells[first] + cell[first];
    };
    std::vector<double> rim(static_cast<std::size_t>(config.cells[first]) *
                            config.cells[second]);
    if (const auto cells = in.cells_at(side)) {
        for_each_cell(*cells, [&](const Cell& local) {
            const Cell cell = global(in, local);
            if (in.solids->solid(local) && !holds_centre(config, side, cell))
                rim[index(cell)] = 1;
        });
    }
    MPI_Allreduce(MPI_IN_PLACE, rim.data(), static_cast<int>(rim.size()), MPI_DOUBLE,
                  MPI_SUM, in.comm);
    const auto velocity = inlet_velocity(config, side);
    double all = 0, lost = 0;
    for_each_cell(*cells_at_side({{0, 0, 0}, config.cells}, config.cells, side),
                  [&](const Cell& cell) {
                      if (!is_open(config, side, cell)) return;
                      const double flow = velocity(cell)[axis_of(side)];
                      all += flow;
                      lost += rim[index(cell)] * flow;
                  });
    return lost == 0 || lost == all ? 1 : all / (all - lost);
}

VelocityInlet::VelocityInlet(const SideContext& in, int side, const CellBox& side_cells,
                             double scale)
    : side_(side),
      cells_(side_cells),
      in_plane_(in_plane(side)),
      stride_(cells_.hi[in_plane_[0]] - cells_.lo[in_plane_[0]] + 2),
      ramp_(in.config.boundaries[side].inlet.ramp_s / in.config.time_step_s),
      step_s_(in.config.time_step_s),
      course_(in.config.boundaries[side].inlet.factor) {
    const int rows = cells_.hi[in_plane_[1]] - cells_.lo[in_plane_[1]] + 2;
    velocity_.resize(static_cast<std::size_t>(stride_) * rows);
    open_.resize(velocity_.size());
    const auto steady = inlet_velocity(in.config, side);
    CellBox margin = cells_;
    for (int a : in_plane_) {
        --margin.lo[a];
        ++margin.hi[a];
    }
    for_each_cell(margin, [&](const Cell& local) {
        const Cell cell = global(in, local);
        bool inside = true;
        for (int a = 0; a < 3; ++a)
            inside = inside && cell[a] >= 0 && cell[a] < in.config.cells[a];
        if (!inside || !is_open(in.config, side, cell)) return;
        open_[index(local)] = 1;
        velocity_[index(local)] = steady(cell);
        for (double& component : velocity_[index(local)]) component *= scale;
    });
    for_each_cell(cells_, [&](const Cell& local) {
        if (open_[index(local)]) open_cells_.push_back(local);
    });
    if (!may_leave(in.config, side)) return;
    std::ranges::copy_if(
        open_cells_, std::back_inserter(leaving_cells_),
        [&](const Cell& cell) { return !(in.solids && in.solids->solid(cell)); });
    leaving_ = outflow_cells(in, side, leaving_cells_);
}

// Change of the velocity over one cell along an axis; one-sided at the rim of the
// opening.
Vec3 VelocityInlet::slope(const Cell& local, int axis) const {
    Cell low = local, high = local;
    --low[axis];
    ++high[axis];
    const int below = open_[index(low)] ? index(low) : index(local);
    const int above = open_[index(high)] ? index(high) : index(local);
    const int steps = (below != index(local)) + (above != index(local));
    Vec3 rise{};
    for (int a = 0; a < 3 && steps > 0; ++a) {
        rise[a] = (velocity_[above][a] - velocity_[below][a]) / steps;
    }
    return rise;
}

// Adds the inlet's terms. A link crosses the side half a cell beside the face's centre,
// where the velocity follows from the slope. Without the slope, the shear at an inlet
// with a profile is wrong by a fraction that does not fall with the spacing. In the flux,
// links that lean to opposite sides cancel, unless a tangential velocity changes along
// its own direction; the flux that this adds is taken from the link straight through the
// face.
template <class Real>
void VelocityInlet::add(const PopulationRows<Real>& rows, const RowLayout& layout,
                        double factor) const {
    const int axis = axis_of(side_);
    for (const Cell& cell : open_cells_) {
        const Vec3& centre = velocity_[index(cell)];
        const Vec3 slopes[2] = {slope(cell, in_plane_[0]), slope(cell, in_plane_[1])};
        const int row = layout.row(cell[1], cell[2]);
        double owed = inward(side_) * centre[axis];
        int straight = 0;
        for (int q = 1; q < directions; ++q) {
            if (c[q][axis] != inward(side_)) continue;
            if (c[q][in_plane_[0]] == 0 && c[q][in_plane_[1]] == 0) straight = q;
            double cu = 0;
            for (int a = 0; a < 3; ++a) {
                // The link comes from -c_q.
                const double u = centre[a] - 0.5 * c[q][in_plane_[0]] * slopes[0][a] -
                                 0.5 * c[q][in_plane_[1]] * slopes[1][a];
                cu += c[q][a] * u;
            }
            Real& f = rows.row(q, row)[cell[0]];
            f = static_cast<Real>(f + 6 * weight(q) * factor * cu);
            owed -= 6 * weight(q) * cu;
        }
        Real& f = rows.row(straight, row)[cell[0]];
        f = static_cast<Real>(f + factor * owed);
    }
}

// Rebuilds the cells by which flow leaves in this step, with the prescribed normal
// velocity and the tangential velocity of the next cell inwards.
template <class Real>
void VelocityInlet::let_out(Real* base, int arrangement) const {
    const int axis = axis_of(side_);
    for (std::size_t i = 0; i < leaving_.size(); ++i) {
        const double entering =
            factor_ * inward(side_) * velocity_[index(leaving_cells_[i])][axis];
        if (!(entering < 0)) continue;
        double f[directions], inner[directions];
        gather(base, leaving_[i].slots[arrangement], f);
        gather(base, leaving_[i].inner_slots[arrangement], inner);
        LocalFlow flow = flow_of(inner);
        flow.density_excess = flow_of(f).density_excess;
        flow.velocity[axis] = inward(side_) * entering / (1 + flow.density_excess);
        rebuild(f, axis, -inward(side_), flow);
        scatter(f, leaving_[i].slots[arrangement], base);
    }
}

}  // namespace

std::unique_ptr<SideEffect> make_velocity_inlet_effect(const SideContext& in, int side) {
    if (may_leave(in.config, side)) check_depth(in.decomposition, side);
    const double scale = scale_at_rim(in, side);
    const auto cells = in.cells_at(side);
    return cells ? std::make_unique<VelocityInlet>(in, side, *cells, scale) : nullptr;
}

}  // namespace magfsi::fluid
