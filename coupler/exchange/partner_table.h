// Which markers each fluid rank can meet. Renewed every few coupled steps with a margin
// that a marker cannot cross in between, so that in most steps a structure rank sends
// only to the fluid ranks that hold its markers, and nobody has to announce anything.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coupler/exchange/message.h"
#include "coupler/immersed_boundary/delta_kernel.h"
#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

constexpr std::int64_t renew_every = 5;  // coupled steps
constexpr int renew_margin_cells = 2;    // 0.4 cells a step, all that the lattice allows

// Markers of a step may be those of a new table: before the first and in every fifth,
// but not again when it is repeated.
inline bool renews_partners(const Occasion& when) {
    if (when.iteration > 0) return false;
    return when.step < 0 || (when.step > 0 && when.step % renew_every == 0);
}

// Whether a marker at point_m, moved by up to the margin, touches a cell of the box.
bool may_touch(const Grid& grid, Kernel kernel, const CellBox& box, const Vec3& point_m);

// For each fluid rank the markers it may meet, ascending. Throws Diverged when a point
// lies outside a box without periodic sides.
std::vector<std::vector<int>> partner_table(const Grid& grid, Kernel kernel,
                                            std::span<const Vec3> points_m);

// Throws Diverged when a marker moved further than the margin since the table was made.
void check_margin(const Grid& grid, std::span<const Vec3> then_m,
                  std::span<const Vec3> now_m, std::int64_t step);

}  // namespace magfsi::coupler
