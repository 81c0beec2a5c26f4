// SPDX-License-Identifier: GPL-2.0-or-later
// Regridding: patches are made, follow the bodies, and take over the state of the patches
// before them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid_lbm/refinement/cells_beside.h"
#include "fluid_lbm/refinement/finer_levels.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// Fills a new patch: from the old patches of its level where they overlap, and elsewhere
// by interpolation from the level below.
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

// Mass of this rank's part of a box beyond that at rest, in cells of the level at rest.
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

// Mass of the finer levels beyond that of the cells that they cover, over all ranks, in
// cells of level 0 at rest. Collective.
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

// Makes the patches of a nest, from the coarsest on. Cells that old patches solved are
// copied, the others are interpolated from the level below, whose cells under old patches
// cover_all() has overwritten.
void RefinedFluid::add_nest(const NestPlaces& places, const std::vector<Nest>& old,
                            bool first) {
    FluidConfig at_rest = config_.coarse;
    if (!first) {
        at_rest.initial_velocity = nullptr;
        at_rest.initial_pressure = nullptr;
    }
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
        finer.mass.beside =
            summed(comm_, static_cast<double>(cells_beside(below, places[i])));
        if (first) continue;
        finer.level.fluid.set_steps_done(steps_done_ >> (places.size() - i - 1));
        std::vector<const Level*> patches;
        for (const Nest& from : old)
            if (!from.empty()) patches.push_back(&from[i]->level);
        take_over(below, patches, finer.level, periodic_axes(config_.coarse));
    }
}

// Nests that keep their places stay; the others end, and new ones take over. The mass
// that the change gains or loses is owed to the outermost interface of a new nest.
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
            stays[same - places.begin()] = std::exchange(old[n], {});
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
    // The mass passes through the outermost interface that exists: a patch may cover the
    // whole of a periodic box and have none.
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
        refuse_bodies_at_sides(config_.coarse, config_.rule, config_.least_margin_cells,
                               bodies_m, now);
        return false;
    }
    const auto places = place_nests(config_.coarse, config_.rule, bodies_m, &now);
    if (places) regrid(*places);
    return places.has_value();
}

void RefinedFluid::restore(std::int64_t steps, const std::vector<NestPlaces>& places,
                           const std::vector<double>& kept_mass) {
    levels_->nests.clear();
    regrid(places);
    steps_done_ = steps;
    // In the middle of a level's step the levels below have already taken theirs.
    for_each_patch([&](int l, int nest) {
        const std::int64_t in_one = steps_in_one(l);
        level(l, nest).set_steps_done((steps + in_one - 1) / in_one);
    });
    const double* number = kept_mass.data();
    if (kept_mass.empty()) return;  // a state of an older version has none
    for (const Nest& nest : levels_->nests) {
        for (const auto& finer : nest) {
            finer->mass.owed = *number++;
            finer->mass.lost = *number++;
        }
    }
}

}  // namespace magfsi::fluid
