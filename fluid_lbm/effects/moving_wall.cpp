// SPDX-License-Identifier: GPL-2.0-or-later
// Walls that move along themselves: half-way bounce-back adds 6 w rho0 c.u_w to each
// population that leaves the wall (Ladd 1994), rho0 = 1.
#include "fluid_lbm/boundary/boundaries.h"

namespace magfsi::fluid {

namespace {

using namespace d3q19;

// True if the link that brings population q to a cell passes through an edge of the side,
// where another wall begins along `axis`. index: of the cell along that axis.
bool through_edge(const RowLayout& layout, int axis, int q, int index) {
    if (c[q][axis] == 0) return false;
    const int from = index - c[q][axis];
    if (axis == 1) return cross(from, layout.ny, layout.beyond_y).wall;
    if (axis == 2) return cross(from, layout.nz, layout.beyond_z).wall;
    return layout.beyond_x == Beyond::wall && (from < 0 || from >= layout.nx);
}

// Adds the wall's term to the slots that hold bounced populations; in both arrangements
// these are the natural slots of the cells at the wall. A link through an edge takes the
// mean velocity of the two walls that meet there: in a lid-driven cavity this halves the
// error against a converged solution, and the box loses at one end of a wall the mass
// that it gains at the other. Where one of the ends is no wall, that balance fails. At an
// inlet the links through the edge are the inlet's, and the mass that links gain at the
// other end is taken from the link straight from the wall.
class MovingWall final : public SideEffect {
  public:
    // velocity: tangential velocity of the wall in cells per step.
    MovingWall(int side, const CellBox& cells, const Vec3& velocity,
               const std::array<Boundary, 6>& sides)
        : side_(side), cells_(cells), velocity_(velocity) {
        for (int a = 0; a < 3; ++a) {
            for (int end = 0; end < 2; ++end) {
                const BoundaryKind kind = sides[2 * a + end].kind;
                inlet_[a][end] = kind == BoundaryKind::velocity_inlet;
                balanced_[a] = balanced_[a] && (kind == BoundaryKind::no_slip ||
                                                kind == BoundaryKind::periodic);
            }
        }
    }

    void after_exchange(const Populations& populations, const RowLayout& layout,
                        double) override {
        for (int q = 1; q < directions; ++q) {
            if (c[q][axis_of(side_)] != inward(side_)) continue;
            const double cu =
                c[q][0] * velocity_[0] + c[q][1] * velocity_[1] + c[q][2] * velocity_[2];
            if (cu == 0) continue;
            populations.visit([&](const auto& rows) {
                add_to_cells(rows, layout, q, 6 * weight(q) * cu);
                balance_edges(rows, layout, q, 6 * weight(q) * cu);
            });
        }
    }

  private:
    // Adds `term` to population q of the cells at the wall. Links through an edge take
    // half of it: their velocity is the mean of two walls, and the other wall adds its
    // own half.
    template <class Real>
    void add_to_cells(const PopulationRows<Real>& rows, const RowLayout& layout, int q,
                      double term) const {
        const auto at_edge = [&](int axis, int index) {
            return axis != axis_of(side_) && through_edge(layout, axis, q, index);
        };
        for (int z = cells_.lo[2]; z < cells_.hi[2]; ++z) {
            for (int y = cells_.lo[1]; y < cells_.hi[1]; ++y) {
                Real* row = rows.row(q, layout.row(y, z));
                const bool edge = at_edge(1, y) || at_edge(2, z);
                const auto add = [&](int x, double share) {
                    row[x] = static_cast<Real>(row[x] + share * term);
                };
                // Only the ends of a row touch a wall along x.
                const int first = cells_.lo[0], last = cells_.hi[0] - 1;
                add(first, edge || at_edge(0, first) ? 0.5 : 1);
                for (int x = first + 1; x < last; ++x) add(x, edge ? 0.5 : 1);
                if (last > first) add(last, edge || at_edge(0, last) ? 0.5 : 1);
            }
        }
    }

    // Takes back the half term that add_to_cells() has given to a link through an edge,
    // along axes of which one end is no wall. At an inlet it is taken from that link,
    // elsewhere from the one straight from the wall.
    template <class Real>
    void balance_edges(const PopulationRows<Real>& rows, const RowLayout& layout, int q,
                       double term) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (axis == axis_of(side_) || c[q][axis] == 0 || balanced_[axis]) continue;
            const int end = c[q][axis] > 0 ? 0 : 1;
            CellBox cells = cells_;
            (end == 0 ? cells.hi : cells.lo)[axis] =
                end == 0 ? cells.lo[axis] + 1 : cells.hi[axis] - 1;
            const int index = cells.lo[axis];
            if (!through_edge(layout, axis, q, index)) continue;
            int from = q;
            for (int s = 1; s < directions && !inlet_[axis][end]; ++s) {
                const bool straight =
                    c[s][axis_of(side_)] == inward(side_) && weight(s) > weight(q);
                if (straight) from = s;
            }
            for (int z = cells.lo[2]; z < cells.hi[2]; ++z) {
                for (int y = cells.lo[1]; y < cells.hi[1]; ++y) {
                    Real* row = rows.row(from, layout.row(y, z));
                    for (int x = cells.lo[0]; x < cells.hi[0]; ++x)
                        row[x] = static_cast<Real>(row[x] - 0.5 * term);
                }
            }
        }
    }

    int side_;
    CellBox cells_;  // at the wall, in local indices
    Vec3 velocity_;
    std::array<std::array<bool, 2>, 3> inlet_{};  // [axis][end]: an inlet is there
    // Both ends of the axis are walls or periodic.
    std::array<bool, 3> balanced_{true, true, true};
};

}  // namespace

std::unique_ptr<SideEffect> make_moving_wall_effect(const SideContext& in, int side) {
    const auto cells = in.cells_at(side);
    if (!cells) return nullptr;
    return std::make_unique<MovingWall>(side, *cells, wall_velocity(in.config, side),
                                        in.config.boundaries);
}

}  // namespace magfsi::fluid
