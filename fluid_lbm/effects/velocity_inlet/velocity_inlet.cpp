#include "fluid_lbm/effects/velocity_inlet/velocity_inlet.h"

namespace magfsi::fluid {

using namespace d3q19;

VelocityInlet::VelocityInlet(const LatticeSide& side, int side_index,
                             const CellBox& side_cells, const CellBox& owned,
                             const std::array<int, 3>& box_cells,
                             const std::array<bool, 3>& periodic)
    : side_(side),
      side_index_(side_index),
      cells_(side_cells),
      origin_(owned.lo),
      box_cells_(box_cells),
      periodic_(periodic) {
    const int axis = axis_of(side_index);
    in_plane_ = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
    stride_ = cells_.hi[in_plane_[0]] - cells_.lo[in_plane_[0]] + 2;
    const int rows = cells_.hi[in_plane_[1]] - cells_.lo[in_plane_[1]] + 2;
    velocity_.resize(static_cast<std::size_t>(stride_) * rows);
    open_.resize(velocity_.size());
    find_open();
    if (side_.course) {
        follow_course(0);
    } else {
        for (const Sampled& s : sampled_) velocity_[s.at] = side_.velocity(s.global);
    }
}

int VelocityInlet::index(const Cell& local) const {
    const int i = local[in_plane_[0]] - cells_.lo[in_plane_[0]] + 1;
    const int j = local[in_plane_[1]] - cells_.lo[in_plane_[1]] + 1;
    return j * stride_ + i;
}

void VelocityInlet::find_open() {
    CellBox margin = cells_;
    for (int a : in_plane_) {
        --margin.lo[a];
        ++margin.hi[a];
    }
    for_each_cell(margin, [&](const Cell& local) {
        Cell cell;
        bool inside = true;
        for (int a = 0; a < 3; ++a) {
            cell[a] = origin_[a] + local[a];
            if (periodic_[a]) cell[a] = (cell[a] + box_cells_[a]) % box_cells_[a];
            inside = inside && cell[a] >= 0 && cell[a] < box_cells_[a];
        }
        const int at = index(local);
        open_[at] = inside && (!side_.open || side_.open(cell));
        if (open_[at]) sampled_.push_back({at, cell});
    });
    for_each_cell(cells_, [&](const Cell& local) {
        if (open_[index(local)]) open_cells_.push_back(local);
    });
}

void VelocityInlet::follow_course(double time) {
    for (const Sampled& s : sampled_) velocity_[s.at] = side_.course(s.global, time);
}

// Change of the velocity over one cell; one-sided at the rim of the opening.
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

// A link crosses the side half a cell sideways of the face's centre: the velocity there
// follows from the slope. Without it the shear at an inlet with a profile is wrong by a
// fraction that does not fall with the spacing; the flux is the same, since links that
// lean to opposite sides cancel.
template <class Real>
void VelocityInlet::add(const PopulationRows<Real>& rows, const RowLayout& layout,
                        double factor) const {
    const int axis = axis_of(side_index_);
    for (const Cell& cell : open_cells_) {
        const Vec3& centre = velocity_[index(cell)];
        const Vec3 slopes[2] = {slope(cell, in_plane_[0]), slope(cell, in_plane_[1])};
        const int row = layout.row(cell[1], cell[2]);
        for (int q = 1; q < directions; ++q) {
            if (c[q][axis] != inward(side_index_)) continue;
            double cu = 0;
            for (int a = 0; a < 3; ++a) {
                // The link comes from -c_q.
                const double u = centre[a] - 0.5 * c[q][in_plane_[0]] * slopes[0][a] -
                                 0.5 * c[q][in_plane_[1]] * slopes[1][a];
                cu += c[q][a] * u;
            }
            Real& f = rows.row(q, row)[cell[0]];
            f = static_cast<Real>(f + 6 * weight(q) * factor * cu);
        }
    }
}

void VelocityInlet::apply(const Populations& populations, const RowLayout& layout,
                          double time) {
    if (side_.course) follow_course(time);
    const double factor = side_.factor && !side_.course ? side_.factor(time) : 1;
    populations.visit([&](const auto& rows) { add(rows, layout, factor); });
}

}  // namespace magfsi::fluid
