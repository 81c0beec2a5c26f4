#include "fluid_lbm/boundary/moving_wall.h"

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

template <class Real>
void add_to_cells(const PopulationRows<Real>& rows, const RowLayout& layout, int q,
                  const Touching& cells, double term) {
    for (int z = cells.lo[2]; z < cells.hi[2]; ++z) {
        for (int y = cells.lo[1]; y < cells.hi[1]; ++y) {
            Real* row = rows.row(q, layout.row(y, z));
            for (int x = cells.lo[0]; x < cells.hi[0]; ++x) {
                row[x] = static_cast<Real>(row[x] + term);
            }
        }
    }
}

}  // namespace

void move_walls(const Populations& populations, const RowLayout& layout,
                const std::vector<MovingWall>& walls) {
    for (const MovingWall& wall : walls) {
        const Touching cells = cells_at(wall, layout);
        for (int q = 1; q < directions; ++q) {
            if (c[q][wall.axis] != (wall.side == 0 ? 1 : -1)) continue;
            const double cu = c[q][0] * wall.velocity[0] + c[q][1] * wall.velocity[1] +
                              c[q][2] * wall.velocity[2];
            if (cu == 0) continue;
            populations.visit([&](const auto& rows) {
                add_to_cells(rows, layout, q, cells, 6 * weight(q) * cu);
            });
        }
    }
}

}  // namespace magfsi::fluid
