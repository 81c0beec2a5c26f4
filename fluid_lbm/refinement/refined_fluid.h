// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid with nests of finer patches over its uniform grid (refinement/nests.h), after
// Lagrava et al. (2012). One step of it is a step of the finest level; a level steps in
// every second step of the next finer one. Forces act in cells of the finest level alone.
//
//   before the steps 0, 2, 4, ... of a level  its ring is filled from the level below,
//                                             which then takes its own step
//   after the steps 1, 3, 5, ...              the level below is overwritten where it is
//                                             covered
//
// SI; cells of the finest level count from the corner of the whole box.
#pragma once

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/refinement/nests.h"

namespace magfsi::fluid {

struct FinerLevel;

// Configuration of a fluid with finer levels.
struct RefinedConfig {
    FluidConfig coarse;  // level 0; its time step is 2^levels steps of this fluid
    PatchRule rule{};
    int least_margin_cells = 0;  // least margin of bodies in a patch that does not follow
    bool obstacle_forces = false;  // true if forces on obstacles are read
};

// The whole fluid of one communicator. Functions named as those of Fluid do the same.
class RefinedFluid {
  public:
    // Sets up level 0 and patches around bodies in these boxes. Collective. Throws
    // std::invalid_argument on a configuration that cannot run.
    RefinedFluid(MPI_Comm comm, const RefinedConfig& config,
                 const std::vector<BodyBox>& bodies_m);
    ~RefinedFluid();
    RefinedFluid(const RefinedFluid&) = delete;
    RefinedFluid& operator=(const RefinedFluid&) = delete;

    const RefinedConfig& config() const { return config_; }
    // Number of levels, level 0 included.
    int levels() const { return 1 + config_.rule.levels; }
    int nests() const;
    // The fluid and the place of a patch; level 0 is common to all nests.
    const Fluid& level(int number, int nest = 0) const;
    const LevelPlace& place(int number, int nest = 0) const;
    std::vector<NestPlaces> places() const;

    // Cells of the finest level that each rank solves: boxes in the patches of all nests,
    // without their rings.
    std::vector<std::vector<CellBox>> owned_by_rank() const;
    // The same for one patch of any level, one box per rank.
    std::vector<CellBox> inside_by_rank(int level, int nest = 0) const;
    // Cells of a patch, or of level 0, in place of which finer patches count.
    std::vector<CellBox> covered(int level, int nest) const;
    // Functions as those of Fluid, in cells of the finest level that the rank owns.
    void velocity(std::span<const CellRow> rows, std::span<double> out,
                  std::span<double> relative_density = {}) const;
    void set_force(std::span<const CellRow> rows, std::span<const double> force);
    void step();
    void keep();
    void go_back();
    double waited_for_neighbours_s() const;
    std::optional<Divergence> diverged() const;

    // Moves and resizes the nests whose bodies come near their sides; boxes of the bodies
    // in the same order as before. To be called only when levels_are_level(). True if a
    // nest has moved. Throws std::invalid_argument if a patch that does not follow would
    // have to. Collective.
    bool follow(const std::vector<BodyBox>& bodies_m);
    bool levels_are_level() const;  // true if all levels stand at the same time
    std::int64_t moves() const { return moves_; }  // number of moves so far
    // Completes all levels for a reader. From step to step only those covered cells are
    // overwritten that the levels need; this overwrites all of them and fills the rings
    // as before a step. Coming steps do not change by it. Collective.
    void cover_all();

    // Sums over the box, each place counted once, with the finest level there.
    // Collective.
    Totals totals() const;
    double enstrophy_1_s2();
    // Flow through a plane on level 0, whose covered cells are first overwritten from the
    // finer levels. Collective.
    PlaneFlow plane_flow(int axis, double at_m) {
        cover_all();
        return level(0).plane_flow(axis, at_m);
    }
    // Force [N] on each obstacle, mean over the last whole step of level 0. Collective.
    std::vector<Vec3> obstacle_forces() const;
    // Solid cells of the whole box in the finest level's spacing, as rows.
    std::vector<CellRow> solid_rows() const;

    // The state between steps consists of the steps, the places of the levels, the mass
    // that is kept for the interfaces, and the populations of each level
    // (Fluid::populations). It is put back in this order. In the middle of a step of
    // level 0 a part of the kept mass is each rank's own.
    std::int64_t steps_done() const { return steps_done_; }
    std::vector<double> kept_mass() const;
    void restore(std::int64_t steps, const std::vector<NestPlaces>& places,
                 const std::vector<double>& kept_mass);
    Fluid& level(int number, int nest = 0);

  private:
    struct Levels;
    using Nest = std::vector<std::unique_ptr<FinerLevel>>;  // level 1 first
    // Calls use(level, nest) for each patch once, level 0 first.
    template <class Use>
    void for_each_patch(Use&& use) const {
        use(0, 0);
        for (int nest = 0; nest < nests(); ++nest)
            for (int l = 1; l < levels(); ++l) use(l, nest);
    }
    // Parts of a step: the levels below the finest take their steps if theirs begins
    // here; the rings are filled; one patch steps; covered cells are overwritten and lost
    // mass is given.
    void begin_step();
    void fill_rings();
    void step_level(int number, int nest);
    void end_step();
    // Mass of the finer levels beyond that of the cells that they cover, over all ranks.
    double excess_of_finer() const;
    // Makes every link to an obstacle count once, in the finest level at its place.
    void count_links_once();
    // Adds (sign 1) or takes off (-1) a patch's part of the forces on obstacles.
    void add_pushes(int number, int nest, double sign);
    // The nest whose finest patch holds a row; the last one if none does.
    int nest_with(const CellRow& row) const;
    // The cells of a patch that no finer patch covers, as boxes in its fluid's indices.
    std::vector<CellBox> counted_of(int level, int nest) const;
    // Makes the patches of these nests and passes the state of the present ones on.
    void regrid(const std::vector<NestPlaces>& places);
    void add_nest(const NestPlaces& places, const std::vector<Nest>& old, bool first);
    // Steps of the finest level in one of a level.
    int steps_in_one(int level) const { return 1 << (levels() - 1 - level); }

    MPI_Comm comm_;
    RefinedConfig config_;
    std::unique_ptr<Levels> levels_;
    std::int64_t steps_done_ = 0, moves_ = 0;
    // This rank's impulses on obstacles over the present step of level 0, as a force [N].
    std::vector<Vec3> pushed_n_;
    bool begun_ = false;  // true if begin_step() has been called for the coming step
};

}  // namespace magfsi::fluid
