// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/interface_flux.h"

#include <algorithm>

#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid {

namespace {

// The box with those sides moved outwards that are interfaces.
CellBox moved_sides(CellBox box, const std::array<std::array<bool, 2>, 3>& open, int by) {
    for (int d = 0; d < 3; ++d) {
        if (open[d][0]) box.lo[d] -= by;
        if (open[d][1]) box.hi[d] += by;
    }
    return box;
}

}  // namespace

InterfaceFlux::InterfaceFlux(const Level& level, const CellBox& box,
                             const LevelPlace& fine)
    : box_(box) {
    const auto& sides = level.state().config.boundaries;
    for (int d = 0; d < 3; ++d) {
        wraps_[d] = fine.period[d] > 0;
        open_[d] = {
            fine.stored.lo[d]<fine.inside.lo[d], fine.stored.hi[d]> fine.inside.hi[d]};
        for (int high = 0; high < 2; ++high)
            mirror_[d][high] = sides[2 * d + high].kind == BoundaryKind::free_slip;
    }
    for (const bool inside : {true, false}) {
        const CellBox outer = inside ? box : moved_sides(box, open_, 1);
        const CellBox inner = inside ? moved_sides(box, open_, -1) : box;
        for (const CellBox& shell : without(outer, inner))
            for_each_row(shell, [&](const CellRow& row) { add_row(level, row, inside); });
    }
}

// True if the population that arrives in a cell along q has come through the interface. A
// population that a wall reflects comes from the cell itself, and one that a side with
// free slip mirrors comes from the cell beside it.
bool InterfaceFlux::crosses(const std::array<int, 3>& cell, int q, bool inside) const {
    bool from_inside = true;
    for (int d = 0; d < 3; ++d) {
        if (wraps_[d]) continue;
        const int from = cell[d] - d3q19::c[q][d];
        const int beyond = from < box_.lo[d] ? 0 : from >= box_.hi[d] ? 1 : -1;
        if (beyond < 0) continue;
        if (open_[d][beyond])
            from_inside = false;
        else if (!mirror_[d][beyond])
            return false;
    }
    return from_inside != inside;
}

void InterfaceFlux::add_row(const Level& level, const CellRow& row, bool inside) {
    const Fluid::State& s = level.state();
    const auto slots = [&](const std::array<int, 3>& local, Arrangement arrangement) {
        return s.populations.visit([&](const auto& rows) {
            return cell_slots(rows, s.layout, arrangement, local);
        });
    };
    // A population that an obstacle returns has crossed no interface.
    const auto at_obstacle = [&](const Cell& local, int q) {
        return s.is_solid(local) ||
               s.is_solid({local[0] - d3q19::c[q][0], local[1] - d3q19::c[q][1],
                           local[2] - d3q19::c[q][2]});
    };
    for_each_image(level.place.period, [&](const std::array<int, 3>& image) {
        const CellBox whole{{row.x_begin, row.y, row.z},
                            {row.x_end, row.y + 1, row.z + 1}};
        const CellBox mine = shared(shifted(whole, image), level.owned());
        if (is_empty(mine)) return;
        const CellRow local =
            level.local({mine.lo[1], mine.lo[2], mine.lo[0], mine.hi[0]});
        constexpr std::size_t none = -1;
        std::array<std::size_t, d3q19::directions> last;  // run of each population
        last.fill(none);
        // Number of cells from x on in which the same populations cross and stand in
        // line: those whose neighbours along x are in the box, too, away from the ends of
        // a stored row.
        const auto alike = [&](int x, int cell_x) {
            const bool inner = level.solids.empty() && x > 0 && cell_x > box_.lo[0];
            const int count =
                std::min({local.x_end - x, s.layout.nx - 1 - x, box_.hi[0] - 1 - cell_x});
            return inner ? std::max(count, 1) : 1;
        };
        for (int x = local.x_begin, count = 1; x < local.x_end; x += count) {
            const CellSlots natural = slots({x, local.y, local.z}, Arrangement::natural),
                            swapped = slots({x, local.y, local.z}, Arrangement::swapped);
            const std::array<int, 3> cell{mine.lo[0] + x - local.x_begin - image[0],
                                          row.y, row.z};
            count = alike(x, cell[0]);
            for (int q = 1; q < d3q19::directions; ++q) {
                if (!crosses(cell, q, inside) || at_obstacle({x, local.y, local.z}, q))
                    continue;
                const std::size_t r = last[q];
                if (r != none && runs_[r].first[0] + runs_[r].count == natural[q] &&
                    runs_[r].first[1] + runs_[r].count == swapped[q]) {
                    runs_[r].count += count;
                } else {
                    last[q] = runs_.size();
                    runs_.push_back(
                        {{natural[q], swapped[q]}, count, inside ? 1.0 : -1.0});
                }
            }
        }
    });
}

double InterfaceFlux::into_box(const Level& level) const {
    // Runs of one cell, at the ends of rows, lie in as many cache lines, which the
    // hardware does not foresee.
    constexpr std::size_t runs_ahead = 24;
    const Fluid::State& s = level.state();
    const int now = s.arrangement == Arrangement::natural ? 0 : 1;
    return s.populations.visit([&]<class Real>(const PopulationRows<Real>& rows) {
        const Real* const base = rows.row(0, 0);
        double sum = 0;
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            if (i + runs_ahead < runs_.size())
                __builtin_prefetch(base + runs_[i + runs_ahead].first[now], 0, 3);
            const Real* f = base + runs_[i].first[now];
            int left = runs_[i].count;
            // Four sums, so that no addition waits for the last.
            double a = 0, b = 0, c = 0, d = 0;
            for (; left >= 4; left -= 4, f += 4) {
                a += f[0];
                b += f[1];
                c += f[2];
                d += f[3];
            }
            for (; left > 0; --left) a += *f++;
            sum += runs_[i].factor * ((a + b) + (c + d));
        }
        return sum;
    });
}

}  // namespace magfsi::fluid
