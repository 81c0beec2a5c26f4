// SPDX-License-Identifier: GPL-2.0-or-later
// Operations on half-open boxes of cells: intersection, difference, growth, images across
// periodic sides, and visits row by row.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/grid/cells.h"

namespace magfsi::fluid {

inline bool is_empty(const CellBox& box) {
    return box.lo[0] >= box.hi[0] || box.lo[1] >= box.hi[1] || box.lo[2] >= box.hi[2];
}

// Intersection of two boxes; empty (is_empty()) if they share no cell.
inline CellBox shared(const CellBox& a, const CellBox& b) {
    CellBox both;
    for (int d = 0; d < 3; ++d) {
        both.lo[d] = std::max(a.lo[d], b.lo[d]);
        both.hi[d] = std::min(a.hi[d], b.hi[d]);
    }
    return both;
}

inline CellBox shifted(const CellBox& box, const std::array<int, 3>& by) {
    CellBox moved = box;
    for (int d = 0; d < 3; ++d) {
        moved.lo[d] += by[d];
        moved.hi[d] += by[d];
    }
    return moved;
}

// The box with `by` more cells on every side.
inline CellBox grown(CellBox box, int by) {
    for (int d = 0; d < 3; ++d) {
        box.lo[d] -= by;
        box.hi[d] += by;
    }
    return box;
}

// Half of a number, rounded towards minus infinity.
inline int floor_half(int value) {
    return value >= 0 ? value / 2 : -((1 - value) / 2);
}

// The same region in cells twice as large: those of which a part lies in the box.
inline CellBox halved(const CellBox& box) {
    CellBox half;
    for (int d = 0; d < 3; ++d) {
        half.lo[d] = floor_half(box.lo[d]);
        half.hi[d] = floor_half(box.hi[d] + 1);
    }
    return half;
}

// True if `inner` lies in `outer`.
inline bool contains(const CellBox& outer, const CellBox& inner) {
    for (int d = 0; d < 3; ++d) {
        if (inner.lo[d] < outer.lo[d] || inner.hi[d] > outer.hi[d]) return false;
    }
    return true;
}

// Number of cells in a box.
inline std::int64_t cells_of(const CellBox& box) {
    std::int64_t count = is_empty(box) ? 0 : 1;
    for (int d = 0; d < 3; ++d) count *= box.hi[d] - box.lo[d];
    return count;
}

// Disjoint boxes that cover `box` without its intersection with `hole`: whole slabs
// across z, then y, then x.
inline std::vector<CellBox> without(CellBox box, const CellBox& hole) {
    std::vector<CellBox> rest;
    const CellBox cut = shared(box, hole);
    if (is_empty(cut)) {
        if (!is_empty(box)) rest.push_back(box);
        return rest;
    }
    for (int d = 2; d >= 0; --d) {
        CellBox low = box, high = box;
        low.hi[d] = cut.lo[d];
        high.lo[d] = cut.hi[d];
        if (!is_empty(low)) rest.push_back(low);
        if (!is_empty(high)) rest.push_back(high);
        box.lo[d] = cut.lo[d];
        box.hi[d] = cut.hi[d];
    }
    return rest;
}

// The same for each of several boxes.
inline std::vector<CellBox> without(const std::vector<CellBox>& boxes,
                                    const CellBox& hole) {
    std::vector<CellBox> rest;
    for (const CellBox& box : boxes) {
        const std::vector<CellBox> left = without(box, hole);
        rest.insert(rest.end(), left.begin(), left.end());
    }
    return rest;
}

// Calls use(shift) for shifts by whole periods (0 along axes without one). They bring the
// cells of the domain to all places of a box that begins in the domain, is no longer than
// it, and reaches up to a stencil of 4 cells beyond itself.
template <class Use>
void for_each_image(const std::array<int, 3>& period, Use&& use) {
    constexpr int stencil = 4;
    const auto along = [&](int d) {
        std::vector<int> images{0};
        for (int by = period[d]; period[d] > 0 && by < 2 * period[d] + stencil;
             by += period[d])
            images.insert(images.end(), {-by, by});
        return images;
    };
    for (const int z : along(2)) {
        for (const int y : along(1)) {
            for (const int x : along(0)) use(std::array<int, 3>{x, y, z});
        }
    }
}

// Calls visit(row) for the rows of a box along x, y fastest.
template <class Visit>
void for_each_row(const CellBox& box, Visit&& visit) {
    if (is_empty(box)) return;
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y)
            visit(CellRow{y, z, box.lo[0], box.hi[0]});
    }
}

}  // namespace magfsi::fluid
