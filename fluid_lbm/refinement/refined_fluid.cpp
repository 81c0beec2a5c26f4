#include "fluid_lbm/refinement/refined_fluid.h"

#include <cmath>

#include "fluid_lbm/refinement/interface_flux.h"
#include "fluid_lbm/refinement/prolongation.h"
#include "fluid_lbm/refinement/restriction.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// Covered cells that nothing reads from step to step are overwritten once in so many
// steps of their level, so that the flow there does not become another.
constexpr std::int64_t steps_until_all_covered = 16;

// Of an interface between two levels, in cells of the coarser at rest: mass that has gone
// into the covered box as the coarser level sees it, less what the finer one has
// received. It goes to the coarse cells beside the patch: what refluxing (Berger, Colella
// 1989) does face by face, in the mean over them.
struct InterfaceMass {
    double lost = 0;   // of this rank, in the coarser level's present step
    double owed = 0;   // besides, of all ranks
    double given = 0;  // by the last step of the coarser level
    double lost_then = 0, owed_then = 0;  // before the last step of the finest level
    std::int64_t beside = 0;              // cells
};

// A level and the two ways between it and the one below.
struct FinerLevel {
    FinerLevel(MPI_Comm comm, const FluidConfig& coarsest, const Level& below,
               const LevelPlace& place, int number)
        : level(comm, coarsest, place, number),
          ring(below, ring_of(level)),
          band(below, level, band_of(place)),
          from_below(below, place.covered(), place),
          into_level(level, place.inside, place) {}

    Restriction& all_covered(const Level& below) {
        if (!whole) whole.emplace(below, level, std::vector{level.place.covered()});
        return *whole;
    }

    Level level;
    Prolongation ring;
    Restriction band;
    std::optional<Restriction> whole;  // of all covered cells, once it is wanted
    InterfaceFlux from_below, into_level;
    InterfaceMass mass;
};

double summed(MPI_Comm comm, double value) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm);
    return value;
}

std::vector<CellRow> local_rows(const Level& level, std::span<const CellRow> rows) {
    std::vector<CellRow> local;
    local.reserve(rows.size());
    const auto& first = level.place.stored.lo;
    for (const CellRow& row : rows)
        local.push_back({row.y - first[1], row.z - first[2], row.x_begin - first[0],
                         row.x_end - first[0]});
    return local;
}

void refuse_obstacles_in(const Level& coarsest, const LevelPlace& place) {
    if (coarsest.state().config.obstacles.empty()) return;
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
            const CellBox met = shared(shifted(cells, image), reach);
            if (is_empty(met)) return;
            refuse("the refined patch meets an obstacle at (", (met.lo[0] + 0.5) * h_m,
                   ", ", (met.lo[1] + 0.5) * h_m, ", ", (met.lo[2] + 0.5) * h_m,
                   ") m, which it cannot hold: keep the bodies further from it, or leave "
                   "fluid.refinement out");
        });
    }
}

}  // namespace

struct RefinedFluid::Levels {
    Levels(MPI_Comm comm, const FluidConfig& coarse)
        : coarsest(comm, coarse, coarsest_place(coarse.cells, periodic_axes(coarse)), 0) {
    }

    Level coarsest;
    std::vector<std::unique_ptr<FinerLevel>> finer;

    Level& at(int number) {
        return number == 0 ? coarsest
                           : finer[static_cast<std::size_t>(number - 1)]->level;
    }
    Level& finest() { return finer.back()->level; }
    FinerLevel& above(int number) { return *finer[static_cast<std::size_t>(number)]; }
};

namespace {

// From a patch to one that stands elsewhere.
void take_over(const Level& below, const Level& old, const Level& level,
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
    Prolongation(below, fresh).run(below, level);
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
        refuse_obstacles_in(levels_->coarsest, places[i]);
        const Level& below = levels_->at(number - 1);
        levels_->finer.push_back(
            std::make_unique<FinerLevel>(comm_, at_rest, below, places[i], number));
        FinerLevel& finer = *levels_->finer.back();
        finer.mass.beside = static_cast<std::int64_t>(
            summed(comm_, static_cast<double>(cells_beside(below, places[i]))));
        if (first) continue;
        finer.level.fluid.set_steps_done(steps_done_ >> (places.size() - i - 1));
        take_over(below, old[i]->level, finer.level, periodic_axes(config_.coarse));
    }
    ++moves_;
    if (!first) levels_->finer.front()->mass.owed = owed + excess - excess_of_finer();
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

std::vector<CellBox> RefinedFluid::counted_of(int number) const {
    const Level& level = levels_->at(number);
    std::vector<CellBox> parts{level.place.inside};
    if (number + 1 < levels())
        for_each_image(level.place.period, [&](const std::array<int, 3>& image) {
            parts = without(parts,
                            shifted(levels_->above(number).level.place.covered(), image));
        });
    for (CellBox& part : parts) {
        for (int d = 0; d < 3; ++d) {
            part.lo[d] -= level.place.stored.lo[d];
            part.hi[d] -= level.place.stored.lo[d];
        }
    }
    return parts;
}

Totals RefinedFluid::totals() const {
    Totals all;
    for (int l = 0; l < levels(); ++l) {
        const Totals of_level = level(l).totals(counted_of(l));
        all.mass_kg += of_level.mass_kg;
        for (std::size_t a = 0; a < 3; ++a)
            all.momentum_kg_m_s[a] += of_level.momentum_kg_m_s[a];
        all.kinetic_energy_j += of_level.kinetic_energy_j;
        all.max_speed_m_s = std::max(all.max_speed_m_s, of_level.max_speed_m_s);
    }
    return all;
}

double RefinedFluid::enstrophy_1_s2() const {
    Enstrophy all;
    for (int l = 0; l < levels(); ++l) {
        const Enstrophy of_level = level(l).enstrophy(counted_of(l));
        all.integral_m3_s2 += of_level.integral_m3_s2;
        all.volume_m3 += of_level.volume_m3;
    }
    return all.integral_m3_s2 / all.volume_m3;
}

double RefinedFluid::waited_for_neighbours_s() const {
    double all = 0;
    for (int l = 0; l < levels(); ++l) all += level(l).waited_for_neighbours_s();
    return all;
}

std::optional<Divergence> RefinedFluid::diverged() const {
    for (int l = levels() - 1; l >= 0; --l) {
        std::optional<Divergence> found = level(l).diverged();
        if (!found) continue;
        const double h_m = level(l).config().spacing_m;
        for (std::size_t d = 0; d < 3; ++d) {
            found->cell[d] += place(l).stored.lo[d];
            found->position_m[d] = (found->cell[d] + 0.5) * h_m;
        }
        found->level = l;
        return found;
    }
    return {};
}

}  // namespace magfsi::fluid
