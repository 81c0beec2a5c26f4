#include "fluid_lbm/effects/moving_wall/moving_wall.h"

namespace magfsi::fluid {

namespace {

using namespace d3q19;

// Cells [lo, hi) that touch the wall.
struct Touching {
    int lo[3], hi[3];
};

Touching cells_at(const MovingWall& wall, const RowLayout& layout) {
    Touching cells{{0, 0, 0}, {layout.nx, layout.ny, layout.nz}};
    if (wall.side == 0) {
        cells.hi[wall.axis] = 1;
    } else {
        cells.lo[wall.axis] = cells.hi[wall.axis] - 1;
    }
    return cells;
}

// Whether the link that brings q to a cell goes through an edge, where another wall
// begins along `axis`.
bool through_edge(const RowLayout& layout, int axis, int q, int index) {
    if (c[q][axis] == 0) return false;
    const int from = index - c[q][axis];
    if (axis == 1) return cross(from, layout.ny, layout.beyond_y).wall;
    if (axis == 2) return cross(from, layout.nz, layout.beyond_z).wall;
    return layout.beyond_x == Beyond::wall && (from < 0 || from >= layout.nx);
}

// term: of links through the wall; those through an edge take half, the mean of two walls
// of which the other one adds its own half.
template <class Real>
void add_to_cells(const PopulationRows<Real>& rows, const RowLayout& layout, int q,
                  const MovingWall& wall, double term) {
    const Touching cells = cells_at(wall, layout);
    const auto at_edge = [&](int axis, int index) {
        return axis != wall.axis && through_edge(layout, axis, q, index);
    };
    for (int z = cells.lo[2]; z < cells.hi[2]; ++z) {
        for (int y = cells.lo[1]; y < cells.hi[1]; ++y) {
            Real* row = rows.row(q, layout.row(y, z));
            const bool edge = at_edge(1, y) || at_edge(2, z);
            const auto add = [&](int x, double share) {
                row[x] = static_cast<Real>(row[x] + share * term);
            };
            // Only the ends of a row touch a wall along x.
            const int first = cells.lo[0], last = cells.hi[0] - 1;
            add(first, edge || at_edge(0, first) ? 0.5 : 1);
            for (int x = first + 1; x < last; ++x) add(x, edge ? 0.5 : 1);
            if (last > first) add(last, edge || at_edge(0, last) ? 0.5 : 1);
        }
    }
}

}  // namespace

void move_walls(const Populations& populations, const RowLayout& layout,
                const std::vector<MovingWall>& walls) {
    for (const MovingWall& wall : walls) {
        for (int q = 1; q < directions; ++q) {
            if (c[q][wall.axis] != (wall.side == 0 ? 1 : -1)) continue;
            const double cu = c[q][0] * wall.velocity[0] + c[q][1] * wall.velocity[1] +
                              c[q][2] * wall.velocity[2];
            if (cu == 0) continue;
            populations.visit([&](const auto& rows) {
                add_to_cells(rows, layout, q, wall, 6 * weight(q) * cu);
            });
        }
    }
}

}  // namespace magfsi::fluid
