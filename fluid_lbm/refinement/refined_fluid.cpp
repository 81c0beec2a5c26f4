// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/refined_fluid.h"

#include <algorithm>

#include "fluid_lbm/refinement/cells_beside.h"
#include "fluid_lbm/refinement/finer_levels.h"

namespace magfsi::fluid {

namespace {

// Number of a level's steps after which all covered cells are overwritten, not only those
// that are read from step to step: otherwise the flow there would drift away.
constexpr std::int64_t steps_until_all_covered = 16;

// Rows of a level as rows of its fluid, which counts from the first stored cell.
std::vector<CellRow> local_rows(const Level& level, std::span<const CellRow> rows) {
    std::vector<CellRow> local;
    local.reserve(rows.size());
    const auto& first = level.place.stored.lo;
    for (const CellRow& row : rows)
        local.push_back({row.y - first[1], row.z - first[2], row.x_begin - first[0],
                         row.x_end - first[0]});
    return local;
}

}  // namespace

RefinedFluid::~RefinedFluid() = default;

int RefinedFluid::nests() const {
    return levels_->nests.size();
}
const Fluid& RefinedFluid::level(int number, int nest) const {
    return levels_->at(number, nest).fluid;
}
Fluid& RefinedFluid::level(int number, int nest) {
    return levels_->at(number, nest).fluid;
}
const LevelPlace& RefinedFluid::place(int number, int nest) const {
    return levels_->at(number, nest).place;
}
std::vector<NestPlaces> RefinedFluid::places() const {
    std::vector<NestPlaces> places;
    for (const Nest& nest : levels_->nests) {
        places.emplace_back();
        for (const auto& finer : nest) places.back().push_back(finer->level.place);
    }
    return places;
}

std::vector<CellBox> RefinedFluid::inside_by_rank(int number, int nest) const {
    const Level& level = levels_->at(number, nest);
    std::vector<CellBox> boxes = level.owned_by_rank();
    for (CellBox& box : boxes) box = shared(box, level.place.inside);
    return boxes;
}

std::vector<std::vector<CellBox>> RefinedFluid::owned_by_rank() const {
    std::vector<std::vector<CellBox>> owned;
    for (int nest = 0; nest < nests(); ++nest) {
        const std::vector<CellBox> by_rank = inside_by_rank(levels() - 1, nest);
        owned.resize(by_rank.size());
        for (std::size_t rank = 0; rank < by_rank.size(); ++rank)
            if (!is_empty(by_rank[rank])) owned[rank].push_back(by_rank[rank]);
    }
    return owned;
}

int RefinedFluid::nest_with(const CellRow& row) const {
    const CellBox cells{{row.x_begin, row.y, row.z}, {row.x_end, row.y + 1, row.z + 1}};
    int nest = 0;
    while (nest + 1 < nests() && !contains(place(levels() - 1, nest).inside, cells))
        ++nest;
    return nest;
}

void RefinedFluid::velocity(std::span<const CellRow> rows, std::span<double> out,
                            std::span<double> relative_density) const {
    // Usually the rows of a nest follow each other, so that one call serves many.
    for (std::size_t i = 0, first_cell = 0; i < rows.size();) {
        const int nest = nest_with(rows[i]);
        std::size_t end = nests() > 1 ? i : rows.size(), cells = 0;
        while (end < rows.size() && nest_with(rows[end]) == nest) ++end;
        for (std::size_t r = i; r < end; ++r)
            cells += static_cast<std::size_t>(rows[r].size());
        const Level& finest = levels_->at(levels() - 1, nest);
        finest.fluid.velocity(local_rows(finest, rows.subspan(i, end - i)),
                              out.subspan(3 * first_cell, 3 * cells),
                              relative_density.empty()
                                  ? relative_density
                                  : relative_density.subspan(first_cell, cells));
        first_cell += cells;
        i = end;
    }
}

void RefinedFluid::set_force(std::span<const CellRow> rows,
                             std::span<const double> force) {
    const auto give = [&](int nest, std::span<const CellRow> its_rows,
                          std::span<const double> its_force) {
        Level& finest = levels_->at(levels() - 1, nest);
        finest.fluid.set_force(local_rows(finest, its_rows), its_force);
    };
    if (nests() == 1) return give(0, rows, force);
    std::vector<std::vector<CellRow>> rows_of(levels_->nests.size());
    std::vector<std::vector<double>> force_of(rows_of.size());
    const double* at = force.data();
    for (const CellRow& row : rows) {
        const std::size_t nest = nest_with(row);
        rows_of[nest].push_back(row);
        const double* end = at + 3 * row.size();
        force_of[nest].insert(force_of[nest].end(), at, end);
        at = end;
    }
    for (std::size_t nest = 0; nest < rows_of.size(); ++nest)
        give(static_cast<int>(nest), rows_of[nest], force_of[nest]);
}

void RefinedFluid::begin_step() {
    if (begun_) return;
    begun_ = true;
    for (int l = 0; l + 1 < levels(); ++l) {
        if (steps_done_ % steps_in_one(l) != 0) continue;
        for (int nest = 0; nest < nests(); ++nest) {
            FinerLevel& above = levels_->above(l, nest);
            above.ring.run(levels_->at(l, nest), above.level);
        }
        for (int nest = 0; nest < (l == 0 ? 1 : nests()); ++nest) step_level(l, nest);
        for (int nest = 0; nest < nests(); ++nest) {
            FinerLevel& above = levels_->above(l, nest);
            above.mass.lost += above.from_below.into_box(levels_->at(l, nest));
        }
    }
}

void RefinedFluid::step_level(int number, int nest) {
    Level& level = levels_->at(number, nest);
    level.fluid.step();
    if (number == 0) std::ranges::fill(pushed_n_, Vec3{});
    if (!pushed_n_.empty()) add_pushes(number, nest, 1);
    if (number == 0) return;
    FinerLevel& finer = levels_->above(number - 1, nest);
    finer.mass.lost -= finer.into_level.into_box(level) / 8;
}

void RefinedFluid::end_step() {
    for (int l = levels() - 2; l >= 0; --l) {
        if (steps_done_ % steps_in_one(l) != 0) continue;
        const bool all = steps_done_ / steps_in_one(l) % steps_until_all_covered == 0;
        for (int nest = 0; nest < nests(); ++nest) {
            FinerLevel& above = levels_->above(l, nest);
            Level& level = levels_->at(l, nest);
            (all ? above.all_covered(level) : above.band).run(level, above.level);
            InterfaceMass& mass = above.mass;
            mass.given = summed(comm_, mass.lost) + mass.owed;
            mass.lost = mass.owed = 0;
            if (mass.beside > 0)
                add_density_beside(level, above.level.place,
                                   mass.given / static_cast<double>(mass.beside));
        }
    }
}

void RefinedFluid::step() {
    begin_step();
    for (const Nest& nest : levels_->nests) {
        for (const auto& finer : nest) {
            finer->mass.lost_then = finer->mass.lost;
            finer->mass.owed_then = finer->mass.owed;
        }
    }
    for (int nest = 0; nest < nests(); ++nest) step_level(levels() - 1, nest);
    begun_ = false;
    ++steps_done_;
    end_step();
}

void RefinedFluid::cover_all() {
    for (int l = levels() - 2; l >= 0; --l) {
        for (int nest = 0; nest < nests(); ++nest) {
            FinerLevel& above = levels_->above(l, nest);
            Level& level = levels_->at(l, nest);
            above.all_covered(level).run(level, above.level);
        }
    }
    fill_rings();
}

// Fills the rings of those levels that stand at the same time as the level below: their
// last two steps have used up what the rings held.
void RefinedFluid::fill_rings() {
    if (begun_) return;
    for (int l = 0; l + 1 < levels(); ++l) {
        if (steps_done_ % steps_in_one(l) != 0) continue;
        for (int nest = 0; nest < nests(); ++nest) {
            FinerLevel& above = levels_->above(l, nest);
            above.ring.run(levels_->at(l, nest), above.level);
        }
    }
}

void RefinedFluid::keep() {
    begin_step();
    for (int nest = 0; nest < nests(); ++nest) level(levels() - 1, nest).keep();
}

void RefinedFluid::go_back() {
    for (int nest = 0; nest < nests(); ++nest) {
        if (!pushed_n_.empty()) add_pushes(levels() - 1, nest, -1);
        level(levels() - 1, nest).go_back();
        for (int l = 0; l + 1 < levels(); ++l) {
            InterfaceMass& mass = levels_->above(l, nest).mass;
            mass.lost = mass.lost_then;
            mass.owed = mass.owed_then;
            // The mass given after the undone step stays in the coarse cells, so that
            // less is owed.
            if (steps_done_ % steps_in_one(l) == 0) mass.owed -= mass.given;
        }
    }
    --steps_done_;
    begun_ = true;
}

bool RefinedFluid::levels_are_level() const {
    return steps_done_ % steps_in_one(0) == 0;
}

std::vector<double> RefinedFluid::kept_mass() const {
    std::vector<double> numbers;
    for (const Nest& nest : levels_->nests) {
        for (const auto& finer : nest)
            numbers.insert(numbers.end(), {finer->mass.owed, finer->mass.lost});
    }
    return numbers;
}

}  // namespace magfsi::fluid
