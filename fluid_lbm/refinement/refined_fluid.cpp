#include "fluid_lbm/refinement/refined_fluid.h"

#include <cmath>

#include "fluid_lbm/refinement/prolongation.h"
#include "fluid_lbm/refinement/restriction.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

// A level and the two ways between it and the one below.
struct FinerLevel {
    FinerLevel(MPI_Comm comm, const FluidConfig& coarsest, const Level& below,
               const LevelPlace& place, int number)
        : level(comm, coarsest, place, number),
          ring(below, ring_of(level)),
          restriction(below, level) {}
    Level level;
    Prolongation ring;
    Restriction restriction;
};

bool is_closed(const FluidConfig& config) {
    return std::ranges::none_of(config.boundaries, [](const Boundary& side) {
        return side.kind == BoundaryKind::velocity_inlet ||
               side.kind == BoundaryKind::pressure_outlet;
    });
}

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

// Streaming and collisions keep the mass of level 0; what restriction changes is known.
// The defect of the whole, uncovered coarse cells and finest ones, goes back to the
// coarse cells beside the patch, through which it came: what refluxing (Berger, Colella
// 1989) does face by face, in the mean over them.
struct RefinedFluid::Mass {
    double whole = 0;   // excess in the beginning; in coarse cells at rest
    double coarse = 0;  // of level 0 with its covered cells
    std::int64_t beside = 0;

    void start(const RefinedFluid& fluid) {
        const FluidConfig& config = fluid.config_.coarse;
        const double cell_kg = units(config).cell_mass_kg();
        const auto excess_of = [&](const Totals& totals, double cells) {
            return totals.mass_kg / cell_kg - cells;
        };
        const Totals level_0 = fluid.level(0).totals();
        const double cells =
            static_cast<double>(cells_of(fluid.place(0).inside));  // which one cancels
        coarse = excess_of(level_0, cells);
        whole = excess_of(fluid.totals(), cells);
    }

    // Sums over all ranks: of the covered coarse cells before and after restriction, and
    // of what covers them, in coarse cells.
    double defect_after(double before, double after, double fine) {
        const double now = coarse - before + fine;
        coarse += after - before;
        return whole - now;
    }
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
    CellTransfer(level.comm(), owned, period, kept)
        .run(
            populations_per_cell,
            [&](const CellRow& row, double* f) {
                read_populations(from, old.local(row), f);
            },
            [&](std::size_t, const CellRow& row, const double* f) {
                write_populations(to, level.local(row), f);
            });
}

}  // namespace

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
        levels_->at(l).fluid.step();
    }
}

void RefinedFluid::end_step() {
    RestrictedMass lowest;
    for (int l = levels() - 2; l >= 0; --l) {
        if (steps_done_ % steps_in_one(l) != 0) continue;
        FinerLevel& above = levels_->above(l);
        const RestrictedMass mass = above.restriction.run(levels_->at(l), above.level);
        // Level by level what covers stands in for what is covered.
        lowest = {mass.fine / 8 - (l + 2 < levels() ? lowest.after - lowest.fine : 0) / 8,
                  mass.before, mass.after};
    }
    if (!mass_ || steps_done_ % steps_in_one(0) != 0) return;
    double sums[3] = {lowest.before, lowest.after, lowest.fine};
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, comm_);
    const double defect = mass_->defect_after(sums[0], sums[1], sums[2]);
    add_density_beside(levels_->coarsest, levels_->above(0).level.place,
                       defect / static_cast<double>(mass_->beside));
    mass_->coarse += defect;
}

void RefinedFluid::step() {
    begin_step();
    levels_->finest().fluid.step();
    begun_ = false;
    ++steps_done_;
    end_step();
}

void RefinedFluid::keep() {
    begin_step();
    levels_->finest().fluid.keep();
}

void RefinedFluid::go_back() {
    levels_->finest().fluid.go_back();
    --steps_done_;
    begun_ = true;
}

bool RefinedFluid::levels_are_level() const {
    return steps_done_ % steps_in_one(0) == 0;
}

// From the coarsest finer level on: cells that the old patch solved are copied, the
// others interpolated from the level below, which restriction has kept right under the
// old patch.
void RefinedFluid::regrid(const std::vector<LevelPlace>& places) {
    FluidConfig at_rest = config_.coarse;
    const bool first = levels_->finer.empty();
    if (!first) {
        at_rest.initial_velocity = nullptr;
        at_rest.initial_pressure = nullptr;
    }
    std::vector<std::unique_ptr<FinerLevel>> old = std::move(levels_->finer);
    levels_->finer.clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        refuse_obstacles_in(levels_->coarsest, places[i]);
        const Level& below = levels_->at(number - 1);
        levels_->finer.push_back(
            std::make_unique<FinerLevel>(comm_, at_rest, below, places[i], number));
        Level& level = levels_->finer.back()->level;
        if (first) continue;
        level.fluid.set_steps_done(steps_done_ >> (places.size() - i - 1));
        take_over(below, old[i]->level, level, periodic_axes(config_.coarse));
    }
    ++moves_;
    if (!is_closed(config_.coarse)) return;
    if (!mass_) {
        mass_ = std::make_unique<Mass>();
        mass_->start(*this);
    }
    mass_->beside = static_cast<std::int64_t>(summed(
        comm_, static_cast<double>(cells_beside(levels_->coarsest, places.front()))));
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
    if (!mass_) return {};
    return {mass_->whole, mass_->coarse};
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
    if (mass_ && kept_mass.size() == 2) {
        mass_->whole = kept_mass[0];
        mass_->coarse = kept_mass[1];
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
