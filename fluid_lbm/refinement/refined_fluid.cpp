// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/refined_fluid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid_lbm/refinement/cells_beside.h"
#include "fluid_lbm/refinement/finer_levels.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// Covered cells that nothing reads from step to step are overwritten once in so many
// steps of their level, so that the flow there does not become another.
constexpr std::int64_t steps_until_all_covered = 16;

std::vector<CellRow> local_rows(const Level& level, std::span<const CellRow> rows) {
    std::vector<CellRow> local;
    local.reserve(rows.size());
    const auto& first = level.place.stored.lo;
    for (const CellRow& row : rows)
        local.push_back({row.y - first[1], row.z - first[2], row.x_begin - first[0],
                         row.x_end - first[0]});
    return local;
}

// Where a patch crosses a periodic side it sees no obstacles beyond it.
void refuse_obstacles_beyond(const Level& coarsest, const LevelPlace& place) {
    const auto reaches_beyond = [&](int d) {
        return place.period[d] == 0 &&
               (place.stored.lo[d] < 0 || place.stored.hi[d] > place.domain[d]);
    };
    if (coarsest.solids.empty()) return;
    if (!reaches_beyond(0) && !reaches_beyond(1) && !reaches_beyond(2)) return;
    const CellBox reach = grown(place.covered(), apart_cells);
    const double h_m = coarsest.state().config.spacing_m;
    for (const CellRow& row : coarsest.fluid.solid_rows()) {
        const CellBox cells{{row.x_begin, row.y, row.z},
                            {row.x_end, row.y + 1, row.z + 1}};
        for_each_image(coarsest.place.period, [&](const std::array<int, 3>& image) {
            if (image == std::array<int, 3>{}) return;
            const CellBox met = shared(shifted(cells, image), reach);
            if (is_empty(met)) return;
            refuse("the refined patch crosses a periodic side and meets an obstacle at (",
                   (met.lo[0] + 0.5) * h_m, ", ", (met.lo[1] + 0.5) * h_m, ", ",
                   (met.lo[2] + 0.5) * h_m,
                   ") m, which it cannot hold: keep the bodies further from it, or leave "
                   "fluid.refinement out");
        });
    }
}

}  // namespace

namespace {

// From patches of a level to one that stands elsewhere.
void take_over(const Level& below, const std::vector<const Level*>& old, Level& level,
               const std::array<bool, 3>& periodic) {
    std::array<int, 3> period{};
    for (int d = 0; d < 3; ++d) period[d] = periodic[d] ? level.place.domain[d] : 0;
    std::vector<std::vector<CellBox>> fresh, kept;
    for (const CellBox& owned : level.owned_by_rank()) {
        fresh.push_back({shared(owned, level.place.inside)});
        kept.push_back({owned});
        for_each_image(period, [&](const std::array<int, 3>& image) {
            for (const Level* patch : old)
                fresh.back() = without(fresh.back(), shifted(patch->place.inside, image));
        });
    }
    Prolongation(below, level.place, fresh).run(below, level);
    std::vector<std::vector<CellBox>> owned(kept.size());
    for (const Level* patch : old) {
        const std::vector<CellBox> by_rank = patch->owned_by_rank();
        for (std::size_t rank = 0; rank < owned.size(); ++rank)
            owned[rank].push_back(shared(by_rank[rank], patch->place.inside));
    }
    const View to = level.state().view();
    CellTransfer(level.comm(), owned, period, kept)
        .run(
            populations_per_cell,
            [&](std::size_t patch, const CellRow& row, double* f) {
                read_populations(old[patch]->state().view(), old[patch]->local(row), f);
            },
            [&](std::size_t, const CellRow& row, const double* f) {
                write_populations(to, level.local(row), f);
            });
    level.reset_solid_cells();
}

// Excess of this rank's part of a box, in cells at rest.
double excess_in(const Level& level, const CellBox& box) {
    double sum = 0;
    RowMoments m;
    for_each_image(level.place.period, [&](const std::array<int, 3>& image) {
        for_each_row(shared(shifted(box, image), level.owned()), [&](const CellRow& row) {
            const CellRow at = level.local(row);
            row_moments(level.state().view(), at.y, at.z, at.x_begin, at.x_end, m);
            for (const double excess : m.excess) sum += excess;
        });
    });
    return sum;
}

}  // namespace

// What finer levels have more than the cells that they cover, all over, in cells of level
// 0 at rest.
double RefinedFluid::excess_of_finer() const {
    double sum = 0;
    for_each_patch([&](int l, int nest) {
        if (l == 0) return;
        const Level &level = levels_->at(l, nest), &below = levels_->at(l - 1, nest);
        sum += std::ldexp(excess_in(level, level.place.inside), -3 * l) -
               std::ldexp(excess_in(below, level.place.covered()), -3 * (l - 1));
    });
    return summed(comm_, sum);
}

RefinedFluid::RefinedFluid(MPI_Comm comm, const RefinedConfig& config,
                           const std::vector<BodyBox>& bodies_m)
    : comm_(comm), config_(config) {
    const auto places = place_nests(config.coarse, config.rule, bodies_m, nullptr);
    levels_ = std::make_unique<Levels>(comm, config_.coarse);
    regrid(*places);
    moves_ = 0;
}

RefinedFluid::~RefinedFluid() = default;

int RefinedFluid::nests() const {
    return static_cast<int>(levels_->nests.size());
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

void RefinedFluid::velocity(std::span<const CellRow> rows, std::span<double> out) const {
    // Rows of one nest follow each other, as a rule.
    for (std::size_t i = 0, first_value = 0; i < rows.size();) {
        const int nest = nest_with(rows[i]);
        std::size_t end = nests() > 1 ? i : rows.size(), values = 0;
        while (end < rows.size() && nest_with(rows[end]) == nest) ++end;
        for (std::size_t r = i; r < end; ++r)
            values += 3 * static_cast<std::size_t>(rows[r].size());
        const Level& finest = levels_->at(levels() - 1, nest);
        finest.fluid.velocity(local_rows(finest, rows.subspan(i, end - i)),
                              out.subspan(first_value, values));
        first_value += values;
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
        const auto nest = static_cast<std::size_t>(nest_with(row));
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
            // What has been given stays where it is.
            if (steps_done_ % steps_in_one(l) == 0) mass.owed -= mass.given;
        }
    }
    --steps_done_;
    begun_ = true;
}

bool RefinedFluid::levels_are_level() const {
    return steps_done_ % steps_in_one(0) == 0;
}

// The patches of a nest, from the coarsest on: cells that old patches solved are copied,
// the others interpolated from the level below, which is made right under the old patch.
void RefinedFluid::add_nest(const NestPlaces& places, const std::vector<Nest>& old,
                            bool first) {
    FluidConfig at_rest = config_.coarse;
    if (!first) {
        at_rest.initial_velocity = nullptr;
        at_rest.initial_pressure = nullptr;
    }
    refuse_obstacles_beyond(levels_->coarsest, places.front());
    const int number_of_nest = nests();
    Nest& nest = levels_->nests.emplace_back();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        const Level& below = levels_->at(number - 1, number_of_nest);
        FinerLevel& finer = *nest.emplace_back(
            std::make_unique<FinerLevel>(comm_, at_rest, below, places[i], number));
        if (config_.rule.follows && config_.obstacle_forces)
            refuse_cut_obstacles(finer.level.fluid.config(), finer.level.solids,
                                 places[i]);
        finer.mass.beside = static_cast<std::int64_t>(
            summed(comm_, static_cast<double>(cells_beside(below, places[i]))));
        if (first) continue;
        finer.level.fluid.set_steps_done(steps_done_ >> (places.size() - i - 1));
        std::vector<const Level*> patches;
        for (const Nest& from : old)
            if (!from.empty()) patches.push_back(&from[i]->level);
        take_over(below, patches, finer.level, periodic_axes(config_.coarse));
    }
}

// Nests that are to stand where they do stay; the others end, and new ones take over.
void RefinedFluid::regrid(const std::vector<NestPlaces>& places) {
    const bool first = levels_->nests.empty();
    double excess = 0, owed = 0;
    if (!first) {
        cover_all();
        excess = excess_of_finer();
    }
    const std::vector<NestPlaces> before = this->places();
    std::vector<Nest> old = std::move(levels_->nests);
    std::vector<Nest> stays(places.size());
    for (std::size_t n = 0; n < old.size(); ++n) {
        const auto same = std::ranges::find(places, before[n]);
        if (same != places.end())
            stays[static_cast<std::size_t>(same - places.begin())] =
                std::exchange(old[n], {});
        for (std::size_t i = 0; i < old[n].size(); ++i)
            owed += std::ldexp(old[n][i]->mass.owed, -3 * static_cast<int>(i));
    }
    levels_->nests.clear();
    std::vector<Nest*> fresh;
    levels_->nests.reserve(places.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
        if (!stays[n].empty()) {
            levels_->nests.push_back(std::move(stays[n]));
        } else {
            add_nest(places[n], old, first);
            fresh.push_back(&levels_->nests.back());
        }
    }
    count_links_once();
    ++moves_;
    if (first || fresh.empty()) return;
    owed += excess - excess_of_finer();
    // Through the outermost interface there is: a patch may cover the whole periodic box.
    const Nest& nest = *fresh.front();
    for (std::size_t i = 0; i < nest.size(); ++i) {
        InterfaceMass& mass = nest[i]->mass;
        if (mass.beside == 0) continue;
        mass.owed = std::ldexp(owed, 3 * static_cast<int>(i));
        break;
    }
}

bool RefinedFluid::follow(const std::vector<BodyBox>& bodies_m) {
    const auto now = places();
    if (!config_.rule.follows) {
        PatchRule rule = config_.rule;
        rule.margin_cells = config_.least_margin_cells;
        if (place_nests(config_.coarse, rule, bodies_m, &now))
            refuse(
                "a body has come to the sides of the refined patch, which stays where it "
                "is: take a larger fluid.refinement.box, or leave it out for a patch "
                "that follows");
        return false;
    }
    const auto places = place_nests(config_.coarse, config_.rule, bodies_m, &now);
    if (places) regrid(*places);
    return places.has_value();
}

std::vector<double> RefinedFluid::kept_mass() const {
    std::vector<double> numbers;
    for (const Nest& nest : levels_->nests) {
        for (const auto& finer : nest)
            numbers.insert(numbers.end(), {finer->mass.owed, finer->mass.lost});
    }
    return numbers;
}

void RefinedFluid::restore(std::int64_t steps, const std::vector<NestPlaces>& places,
                           const std::vector<double>& kept_mass) {
    levels_->nests.clear();
    regrid(places);
    steps_done_ = steps;
    // In the middle of a level's step the levels below have done theirs.
    for_each_patch([&](int l, int nest) {
        const std::int64_t in_one = steps_in_one(l);
        level(l, nest).set_steps_done((steps + in_one - 1) / in_one);
    });
    const double* number = kept_mass.data();
    if (kept_mass.empty()) return;  // of an older state
    for (const Nest& nest : levels_->nests) {
        for (const auto& finer : nest) {
            finer->mass.owed = *number++;
            finer->mass.lost = *number++;
        }
    }
}

}  // namespace magfsi::fluid
