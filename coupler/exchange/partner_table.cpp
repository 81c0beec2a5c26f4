// SPDX-License-Identifier: GPL-2.0-or-later
// The partner table: which fluid ranks a marker can reach until the table is renewed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/exchange/exchange.h"
#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

bool overlap(int a_lo, int a_hi, int b_lo, int b_hi) {
    return a_lo < b_hi && b_lo < a_hi;
}

}  // namespace

// The reach along each axis is half the kernel's support, one cell for rounding to cells,
// and the margin.
bool may_touch(const Grid& grid, Kernel kernel, const CellBox& box, const Vec3& point_m) {
    const int reach = support(kernel) / 2 + 1 + grid.renewal.margin_cells;
    for (std::size_t d = 0; d < 3; ++d) {
        const int n = grid.cells[d];
        int cell = std::floor(point_m[d] / grid.spacing_m);
        if (grid.periodic[d]) cell -= n * static_cast<int>(std::floor(double(cell) / n));
        const int lo = cell - reach;
        const int hi = cell + reach + 1;
        bool any = overlap(lo, hi, box.lo[d], box.hi[d]);
        if (grid.periodic[d]) {
            any = any || overlap(lo - n, hi - n, box.lo[d], box.hi[d]) ||
                  overlap(lo + n, hi + n, box.lo[d], box.hi[d]);
        }
        if (!any) return false;
    }
    return true;
}

std::vector<std::vector<int>> partner_table(const Grid& grid, Kernel kernel,
                                            std::span<const Vec3> points_m) {
    // Throws for a point far outside the box, which would otherwise touch no rank's cells
    // and go unnoticed.
    for (const Vec3& point : points_m) marker_stencil(grid, kernel, point);
    std::vector<std::vector<int>> table(grid.owned_by_rank.size());
    for (std::size_t rank = 0; rank < table.size(); ++rank) {
        const std::vector<CellBox>& boxes = grid.owned_by_rank[rank];
        for (std::size_t m = 0; m < points_m.size(); ++m) {
            if (std::ranges::any_of(boxes, [&](const CellBox& box) {
                    return may_touch(grid, kernel, box, points_m[m]);
                }))
                table[rank].push_back(m);
        }
    }
    return table;
}

void check_margin(const Grid& grid, std::span<const Vec3> then_m,
                  std::span<const Vec3> now_m, std::int64_t step) {
    const double margin_m = grid.renewal.margin_cells * grid.spacing_m;
    for (std::size_t m = 0; m < now_m.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double moved = std::abs(now_m[m][d] - then_m[m][d]);
            if (moved <= margin_m) continue;
            throw Diverged(fmt::format(
                "the body moves too fast for the fluid's grid: in coupled step {} marker "
                "{} at ({:.4g}, {:.4g}, {:.4g}) mm has moved {:.3g} cells in at most {} "
                "steps (limit {}); take a smaller time.step or weaker loads",
                step, m, now_m[m][0] * 1e3, now_m[m][1] * 1e3, now_m[m][2] * 1e3,
                moved / grid.spacing_m, grid.renewal.every, grid.renewal.margin_cells));
        }
    }
}

}  // namespace magfsi::coupler
