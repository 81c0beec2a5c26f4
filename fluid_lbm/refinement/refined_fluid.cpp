// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/refined_fluid.h"

#include <cmath>

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
    CellBox reach = place.covered();
    for (int d = 0; d < 3; ++d) {
        reach.lo[d] -= apart_cells;
        reach.hi[d] += apart_cells;
    }
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

// From a patch to one that stands elsewhere.
void take_over(const Level& below, const Level& old, Level& level,
               const std::array<bool, 3>& periodic) {
    std::array<int, 3> period{};
    for (int d = 0; d < 3; ++d) period[d] = periodic[d] ? level.place.domain[d] : 0;
    std::vector<std::vector<CellBox>> fresh, kept;
    for (const CellBox& owned : level.owned_by_rank()) {
        fresh.push_back({shared(owned, level.place.inside)});
        kept.push_back({owned});
        for_each_image(period, [&](const std::array<int, 3>& image) {
            fresh.back() = without(fresh.back(), shifted(old.place.inside, image));
        });
    }
    Prolongation(below, level.place, fresh).run(below, level);
    const View from = old.state().view(), to = level.state().view();
    std::vector<CellBox> owned = old.owned_by_rank();
    for (CellBox& box : owned) box = shared(box, old.place.inside);
    CellTransfer(level.comm(), one_each(owned), period, kept)
        .run(
            populations_per_cell,
            [&](std::size_t, const CellRow& row, double* f) {
                read_populations(from, old.local(row), f);
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
    for (int l = 1; l < levels(); ++l) {
        const Level& level = levels_->at(l);
        sum += std::ldexp(excess_in(level, level.place.inside), -3 * l) -
               std::ldexp(excess_in(levels_->at(l - 1), level.place.covered()),
                          -3 * (l - 1));
    }
    return summed(comm_, sum);
}

RefinedFluid::RefinedFluid(MPI_Comm comm, const RefinedConfig& config,
                           const std::array<Vec3, 2>& bodies_m)
    : comm_(comm), config_(config) {
    const auto places = place_levels(config.coarse, config.rule, bodies_m, nullptr);
    levels_ = std::make_unique<Levels>(comm, config_.coarse);
    regrid(*places);
    moves_ = 0;
}

RefinedFluid::~RefinedFluid() = default;

int RefinedFluid::levels() const {
    return 1 + static_cast<int>(levels_->finer.size());
}
const Fluid& RefinedFluid::level(int number) const {
    return levels_->at(number).fluid;
}
Fluid& RefinedFluid::level(int number) {
    return levels_->at(number).fluid;
}
const LevelPlace& RefinedFluid::place(int number) const {
    return levels_->at(number).place;
}
std::vector<LevelPlace> RefinedFluid::finer_places() const {
    std::vector<LevelPlace> places;
    for (const auto& finer : levels_->finer) places.push_back(finer->level.place);
    return places;
}

std::vector<CellBox> RefinedFluid::inside_by_rank(int number) const {
    const Level& level = levels_->at(number);
    std::vector<CellBox> boxes = level.owned_by_rank();
    for (CellBox& box : boxes) box = shared(box, level.place.inside);
    return boxes;
}

void RefinedFluid::velocity(std::span<const CellRow> rows, std::span<double> out) const {
    levels_->finest().fluid.velocity(local_rows(levels_->finest(), rows), out);
}

void RefinedFluid::set_force(std::span<const CellRow> rows,
                             std::span<const double> force) {
    levels_->finest().fluid.set_force(local_rows(levels_->finest(), rows), force);
}

void RefinedFluid::begin_step() {
    if (begun_) return;
    begun_ = true;
    for (int l = 0; l + 1 < levels(); ++l) {
        if (steps_done_ % steps_in_one(l) != 0) continue;
        FinerLevel& above = levels_->above(l);
        above.ring.run(levels_->at(l), above.level);
        step_level(l);
        above.mass.lost += above.from_below.into_box(levels_->at(l));
    }
}

void RefinedFluid::step_level(int number) {
    Level& level = levels_->at(number);
    level.fluid.step();
    if (number == 0) std::ranges::fill(pushed_n_, Vec3{});
    if (!pushed_n_.empty()) add_pushes(number, 1);
    if (number == 0) return;
    FinerLevel& finer = levels_->above(number - 1);
    finer.mass.lost -= finer.into_level.into_box(level) / 8;
}

void RefinedFluid::end_step() {
    for (int l = levels() - 2; l >= 0; --l) {
        if (steps_done_ % steps_in_one(l) != 0) continue;
        FinerLevel& above = levels_->above(l);
        Level& level = levels_->at(l);
        const bool all = steps_done_ / steps_in_one(l) % steps_until_all_covered == 0;
        (all ? above.all_covered(level) : above.band).run(level, above.level);
        InterfaceMass& mass = above.mass;
        mass.given = summed(comm_, mass.lost) + mass.owed;
        mass.lost = mass.owed = 0;
        if (mass.beside > 0)
            add_density_beside(level, above.level.place,
                               mass.given / static_cast<double>(mass.beside));
    }
}

void RefinedFluid::step() {
    begin_step();
    for (const auto& finer : levels_->finer) {
        finer->mass.lost_then = finer->mass.lost;
        finer->mass.owed_then = finer->mass.owed;
    }
    step_level(levels() - 1);
    begun_ = false;
    ++steps_done_;
    end_step();
}

void RefinedFluid::cover_all() {
    for (int l = levels() - 2; l >= 0; --l) {
        FinerLevel& above = levels_->above(l);
        above.all_covered(levels_->at(l)).run(levels_->at(l), above.level);
    }
}

void RefinedFluid::keep() {
    begin_step();
    levels_->finest().fluid.keep();
}

void RefinedFluid::go_back() {
    if (!pushed_n_.empty()) add_pushes(levels() - 1, -1);
    levels_->finest().fluid.go_back();
    for (int l = 0; l + 1 < levels(); ++l) {
        InterfaceMass& mass = levels_->above(l).mass;
        mass.lost = mass.lost_then;
        mass.owed = mass.owed_then;
        // What has been given stays where it is.
        if (steps_done_ % steps_in_one(l) == 0) mass.owed -= mass.given;
    }
    --steps_done_;
    begun_ = true;
}

bool RefinedFluid::levels_are_level() const {
    return steps_done_ % steps_in_one(0) == 0;
}

// From the coarsest finer level on: cells that the old patch solved are copied, the
// others interpolated from the level below, which is made right under the old patch.
void RefinedFluid::regrid(const std::vector<LevelPlace>& places) {
    FluidConfig at_rest = config_.coarse;
    const bool first = levels_->finer.empty();
    double excess = 0, owed = 0;
    if (!first) {
        at_rest.initial_velocity = nullptr;
        at_rest.initial_pressure = nullptr;
        cover_all();
        excess = excess_of_finer();
        for (std::size_t i = 0; i < levels_->finer.size(); ++i)
            owed += std::ldexp(levels_->finer[i]->mass.owed, -3 * static_cast<int>(i));
    }
    std::vector<std::unique_ptr<FinerLevel>> old = std::move(levels_->finer);
    levels_->finer.clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        if (i == 0) refuse_obstacles_beyond(levels_->coarsest, places[i]);
        const Level& below = levels_->at(number - 1);
        levels_->finer.push_back(
            std::make_unique<FinerLevel>(comm_, at_rest, below, places[i], number));
        FinerLevel& finer = *levels_->finer.back();
        if (config_.rule.follows && config_.obstacle_forces)
            refuse_cut_obstacles(finer.level.fluid.config(), finer.level.solids,
                                 places[i]);
        finer.mass.beside = static_cast<std::int64_t>(
            summed(comm_, static_cast<double>(cells_beside(below, places[i]))));
        if (first) continue;
        finer.level.fluid.set_steps_done(steps_done_ >> (places.size() - i - 1));
        take_over(below, old[i]->level, finer.level, periodic_axes(config_.coarse));
    }
    count_links_once();
    ++moves_;
    if (first) return;
    owed += excess - excess_of_finer();
    // Through the outermost interface there is: a patch may cover the whole periodic box.
    for (std::size_t i = 0; i < levels_->finer.size(); ++i) {
        InterfaceMass& mass = levels_->finer[i]->mass;
        if (mass.beside == 0) continue;
        mass.owed = std::ldexp(owed, 3 * static_cast<int>(i));
        break;
    }
}

bool RefinedFluid::follow(const std::array<Vec3, 2>& bodies_m) {
    const auto now = finer_places();
    if (!config_.rule.follows) {
        PatchRule rule = config_.rule;
        rule.margin_cells = config_.least_margin_cells;
        if (place_levels(config_.coarse, rule, bodies_m, &now))
            refuse(
                "a body has come to the sides of the refined patch, which stays where it "
                "is: take a larger fluid.refinement.box, or leave it out for a patch "
                "that follows");
        return false;
    }
    const auto places = place_levels(config_.coarse, config_.rule, bodies_m, &now);
    if (places) regrid(*places);
    return places.has_value();
}

std::vector<double> RefinedFluid::kept_mass() const {
    std::vector<double> numbers;
    for (const auto& finer : levels_->finer)
        numbers.insert(numbers.end(), {finer->mass.owed, finer->mass.lost});
    return numbers;
}

void RefinedFluid::restore(std::int64_t steps, const std::vector<LevelPlace>& finer,
                           const std::vector<double>& kept_mass) {
    levels_->finer.clear();
    regrid(finer);
    steps_done_ = steps;
    // In the middle of a level's step the levels below have done theirs.
    for (int l = 0; l < levels(); ++l) {
        const std::int64_t in_one = steps_in_one(l);
        level(l).set_steps_done((steps + in_one - 1) / in_one);
    }
    for (std::size_t i = 0; i < finer.size() && 2 * i + 1 < kept_mass.size(); ++i) {
        levels_->finer[i]->mass.owed = kept_mass[2 * i];
        levels_->finer[i]->mass.lost = kept_mass[2 * i + 1];
    }
}

}  // namespace magfsi::fluid
