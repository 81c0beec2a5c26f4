#include "fluid_lbm/refinement/interface_flux.h"

#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid {

namespace {

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
        open_[d] = {fine.stored.lo[d] < fine.inside.lo[d],
                    fine.stored.hi[d] > fine.inside.hi[d]};
        for (int high = 0; high < 2; ++high)
            mirror_[d][high] = sides[2 * d + high].kind == BoundaryKind::free_slip;
    }
    for (const bool inside : {true, false}) {
        const CellBox outer = inside ? box : moved_sides(box, open_, 1);
        const CellBox inner = inside ? moved_sides(box, open_, -1) : box;
        for (const CellBox& shell : without(outer, inner))
            for_each_row(shell,
                         [&](const CellRow& row) { add_row(level, row, inside); });
    }
}

// Whether what arrives in a cell along q has come through the interface. What a wall
// reflects comes from the cell itself, what a side with free slip mirrors from the cell
// beside it.
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
    std::array<int, 3> cell{row.x_begin, row.y, row.z};
    for_each_image(level.place.period, [&](const std::array<int, 3>& image) {
        const CellBox whole{{row.x_begin, row.y, row.z},
                            {row.x_end, row.y + 1, row.z + 1}};
        const CellBox mine = shared(shifted(whole, image), level.owned());
        if (is_empty(mine)) return;
        const int shift = level.owned().lo[0], first = mine.lo[0], last = mine.hi[0];
        const std::size_t before = runs_.size();
        for (int q = 1; q < d3q19::directions; ++q) {
            for (int x = first; x < last;) {
                // Only the two cells at the ends of a row differ from the others.
                const int end = x >= first + 2 && x < last - 2 ? last - 2 : x + 1;
                cell[0] = x - image[0];
                if (crosses(cell, q, inside))
                    runs_.push_back({q, x - shift, end - shift, inside ? 1.0 : -1.0});
                x = end;
            }
        }
        if (runs_.size() == before) return;
        rows_.push_back(
            {level.local({mine.lo[1], mine.lo[2], first, last}), runs_.size()});
    });
}

double InterfaceFlux::into_box(const Level& level) const {
    const View view = level.state().view();
    double sum = 0;
    std::size_t first = 0;
    for (const Row& row : rows_) {
        sum += sum_of_runs(view, row.cells,
                           std::span(runs_).subspan(first, row.end - first));
        first = row.end;
    }
    return sum;
}

}  // namespace magfsi::fluid
