// SPDX-License-Identifier: GPL-2.0-or-later
// Sides without shear: specular reflection half a cell outside the cells at the side. The
// population that enters a cell is the mirror image of the one that left a neighbour
// along the side. After the sweep both are bounced back, so that reflection is an
// exchange of two values between neighbours: mass and tangential momentum are kept to the
// bit.
#include <utility>

#include "fluid_lbm/boundary/boundaries.h"

namespace magfsi::fluid {

namespace {

class FreeSlip final : public SideEffect {
  public:
    FreeSlip(const SideContext& in, int side, const CellBox& side_cells);

    // Exchanges the populations that lean along the side. At an edge with a wall, an
    // inlet or another side with free slip, the population that comes out of the edge
    // stays bounced back: reflection in the edge.
    void after_exchange(const Populations& populations, const RowLayout& layout,
                        double) override {
        populations.visit([&](const auto& rows) {
            for (const Lean& lean : leans_) {
                swap_inside(rows, layout, lean);
                swap_across(rows, layout, lean);
            }
        });
    }

  private:
    // Reflection along one axis of the side's plane: exchange of population `up`, which
    // leans to the axis's high end, with `down` of the cell below.
    struct Lean {
        int axis, up, down;
        bool wraps;               // the axis is periodic and not cut
        int low_rank, high_rank;  // ranks beyond the ends, or no_rank
    };

    // Exchanges within this rank, and with the ranks beyond the ends.
    template <class Real>
    void swap_inside(const PopulationRows<Real>& rows, const RowLayout& layout,
                     const Lean& lean) const;
    template <class Real>
    void swap_across(const PopulationRows<Real>& rows, const RowLayout& layout,
                     const Lean& lean);

    MPI_Comm comm_;
    CellBox cells_;
    std::vector<Lean> leans_;
    std::vector<double> sent_[2], received_[2];
};

// The slot q of a cell (local indices) in the natural arrangement. Behind a wall side it
// holds the bounced population in both arrangements.
template <class Real>
Real& value(const PopulationRows<Real>& rows, const RowLayout& layout, int q,
            const Cell& cell) {
    return rows.row(q, layout.row(cell[1], cell[2]))[cell[0]];
}

// The cells at one end of the box along an axis.
CellBox end_of(CellBox cells, int axis, int end) {
    (end == 0 ? cells.hi : cells.lo)[axis] =
        end == 0 ? cells.lo[axis] + 1 : cells.hi[axis] - 1;
    return cells;
}

FreeSlip::FreeSlip(const SideContext& in, int side, const CellBox& side_cells)
    : comm_(in.comm), cells_(side_cells) {
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == axis_of(side)) continue;
        int component[3] = {};
        component[axis_of(side)] = inward(side);
        component[axis] = 1;
        Lean lean{};
        lean.axis = axis;
        lean.up = d3q19::direction(component[0], component[1], component[2]);
        component[axis] = -1;
        lean.down = d3q19::direction(component[0], component[1], component[2]);
        lean.low_rank =
            axis == 0 ? no_rank : in.decomposition.neighbour(in.rank, axis, 0);
        lean.high_rank =
            axis == 0 ? no_rank : in.decomposition.neighbour(in.rank, axis, 1);
        const bool cut = lean.low_rank != no_rank || lean.high_rank != no_rank;
        lean.wraps = in.decomposition.periodic[axis] && !cut;
        leans_.push_back(lean);
    }
}

template <class Real>
void FreeSlip::swap_inside(const PopulationRows<Real>& rows, const RowLayout& layout,
                           const Lean& lean) const {
    CellBox upper = cells_;
    if (!lean.wraps) ++upper.lo[lean.axis];
    for_each_cell(upper, [&](const Cell& cell) {
        Cell below = cell;
        below[lean.axis] = cell[lean.axis] == cells_.lo[lean.axis]
                               ? cells_.hi[lean.axis] - 1
                               : cell[lean.axis] - 1;
        std::swap(value(rows, layout, lean.up, cell),
                  value(rows, layout, lean.down, below));
    });
}

// Exchange with the neighbouring ranks: the lowest cells' `up` goes to the rank below,
// the highest cells' `down` to the rank above, and each takes the place of what was sent.
template <class Real>
void FreeSlip::swap_across(const PopulationRows<Real>& rows, const RowLayout& layout,
                           const Lean& lean) {
    const int peer[2] = {lean.low_rank, lean.high_rank};
    const int q[2] = {lean.up, lean.down};
    MPI_Request requests[4];
    int count = 0;
    for (int end = 0; end < 2; ++end) {
        if (peer[end] == no_rank) continue;
        sent_[end].clear();
        for_each_cell(end_of(cells_, lean.axis, end), [&](const Cell& cell) {
            sent_[end].push_back(value(rows, layout, q[end], cell));
        });
        const int size = sent_[end].size();
        received_[end].resize(sent_[end].size());
        // The tag is the end by which the message leaves.
        MPI_Irecv(received_[end].data(), size, MPI_DOUBLE, peer[end], 1 - end, comm_,
                  &requests[count++]);
        MPI_Isend(sent_[end].data(), size, MPI_DOUBLE, peer[end], end, comm_,
                  &requests[count++]);
    }
    MPI_Waitall(count, requests, MPI_STATUSES_IGNORE);
    for (int end = 0; end < 2; ++end) {
        if (peer[end] == no_rank) continue;
        const double* from = received_[end].data();
        for_each_cell(end_of(cells_, lean.axis, end), [&](const Cell& cell) {
            value(rows, layout, q[end], cell) = static_cast<Real>(*from++);
        });
    }
}

}  // namespace

std::unique_ptr<SideEffect> make_free_slip_effect(const SideContext& in, int side) {
    const auto cells = in.cells_at(side);
    return cells ? std::make_unique<FreeSlip>(in, side, *cells) : nullptr;
}

}  // namespace magfsi::fluid
