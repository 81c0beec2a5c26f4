// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/cells_beside.h"

#include "fluid_lbm/refinement/interlevel.h"

namespace magfsi::fluid {

namespace {

// Calls use(row) for the parts of a row of this rank that lie in no obstacle.
template <class Use>
void each_fluid_part(const Level& level, CellRow row, Use&& use) {
    if (level.solids.empty()) return use(row);
    const int first = level.local(row).x_begin - row.x_begin, end = row.x_end;
    const CellRow local = level.local(row);
    const auto solid = [&](int x) {
        return level.state().is_solid({x + first, local.y, local.z});
    };
    for (int x = row.x_begin; x < end;) {
        row.x_begin = x;
        while (x < end && !solid(x)) ++x;
        row.x_end = x++;
        if (row.size() > 0) use(row);
    }
}

// Calls use(row) for each row of this rank's coarse fluid cells beside the covered box.
template <class Use>
void each_row_beside(const Level& coarse, const LevelPlace& fine, Use&& use) {
    const CellBox covered = fine.covered();
    CellBox around = covered;
    for (int d = 0; d < 3; ++d) {
        if (fine.period[d] > 0) continue;
        around.lo[d] -= 1;
        around.hi[d] += 1;
    }
    for (const CellBox& box : without(around, covered)) {
        for_each_image(coarse.place.period, [&](const std::array<int, 3>& image) {
            for_each_row(shared(shifted(box, image), coarse.owned()),
                         [&](const CellRow& row) { each_fluid_part(coarse, row, use); });
        });
    }
}

}  // namespace

std::int64_t cells_beside(const Level& coarse, const LevelPlace& fine) {
    std::int64_t cells = 0;
    each_row_beside(coarse, fine, [&](const CellRow& row) { cells += row.size(); });
    return cells;
}

void add_density_beside(const Level& coarse, const LevelPlace& fine, double excess) {
    const View view = coarse.state().view();
    each_row_beside(coarse, fine, [&](const CellRow& row) {
        add_density(view, coarse.local(row), excess);
    });
}

}  // namespace magfsi::fluid
