// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid with nests of finer patches over its uniform grid (refinement/nests.h). One
// step is one of the finest level; a level steps in every second step of the next finer
// one. Forces act in cells of the finest level alone.
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

struct RefinedConfig {
    FluidConfig coarse;  // its time step: 2^levels steps
    PatchRule rule{};
    int least_margin_cells = 0;    // that bodies must keep in a patch that stays
    bool obstacle_forces = false;  // somebody reads them
};

class RefinedFluid {
  public:
    // Patches around bodies in those boxes. Throws std::invalid_argument on a
    // configuration that cannot run.
    RefinedFluid(MPI_Comm comm, const RefinedConfig& config,
                 const std::vector<BodyBox>& bodies_m);
    ~RefinedFluid();
    RefinedFluid(const RefinedFluid&) = delete;
    RefinedFluid& operator=(const RefinedFluid&) = delete;

    const RefinedConfig& config() const { return config_; }
    int levels() const { return 1 + config_.rule.levels; }  // with level 0
    int nests() const;
    // Level 0 is the same in all nests.
    const Fluid& level(int number, int nest = 0) const;
    const LevelPlace& place(int number, int nest = 0) const;
    std::vector<NestPlaces> places() const;

    // Cells of the finest level that each rank solves: boxes in the patches, without
    // their rings.
    std::vector<std::vector<CellBox>> owned_by_rank() const;
    std::vector<CellBox> inside_by_rank(int level, int nest = 0) const;
    // Cells of a patch, or of level 0, that finer patches have instead.
    std::vector<CellBox> covered(int level, int nest) const;
    // As of Fluid, in those cells.
    void velocity(std::span<const CellRow> rows, std::span<double> out,
                  std::span<double> relative_density = {}) const;
    void set_force(std::span<const CellRow> rows, std::span<const double> force);
    void step();
    void keep();
    void go_back();
    double waited_for_neighbours_s() const;
    std::optional<Divergence> diverged() const;

    // Moves and resizes the nests whose bodies, in boxes in the same order as before,
    // come near their sides. Only between steps after which all levels stand at one time.
    // True if it did. Collective.
    bool follow(const std::vector<BodyBox>& bodies_m);
    bool levels_are_level() const;  // all stand at one time
    std::int64_t moves() const { return moves_; }
    // From step to step levels are given only those covered cells that they need; now
    // all, and rings as before a step, for somebody who reads them. Changes nothing in
    // coming steps. Collective.
    void cover_all();

    // Each place of the box counts once, with the finest level there. Collective.
    Totals totals() const;
    double enstrophy_1_s2();
    // Of level 0, which is given what finer levels have.
    PlaneFlow plane_flow(int axis, double at_m) {
        cover_all();
        return level(0).plane_flow(axis, at_m);
    }
    // Mean over the last whole step of level 0.
    std::vector<Vec3> obstacle_forces() const;
    // Cells of the finest level in obstacles, all over the box.
    std::vector<CellRow> solid_rows() const;

    // The state between steps: places and steps of the levels, what keeps the mass, and
    // the populations of each level (Fluid::populations). Put back in this order. In the
    // middle of a step of level 0 a part of the mass is each rank's own.
    std::int64_t steps_done() const { return steps_done_; }
    std::vector<double> kept_mass() const;
    void restore(std::int64_t steps, const std::vector<NestPlaces>& places,
                 const std::vector<double>& kept_mass);
    Fluid& level(int number, int nest = 0);

  private:
    struct Levels;
    using Nest = std::vector<std::unique_ptr<FinerLevel>>;  // level 1 first
    // use(level, nest): each patch once, level 0 first.
    template <class Use>
    void for_each_patch(Use&& use) const {
        use(0, 0);
        for (int nest = 0; nest < nests(); ++nest)
            for (int l = 1; l < levels(); ++l) use(l, nest);
    }
    void begin_step();
    void fill_rings();
    void step_level(int number, int nest);
    void end_step();
    double excess_of_finer() const;
    void count_links_once();
    void add_pushes(int number, int nest, double sign);
    int nest_with(const CellRow& row) const;
    // Boxes of a level where no finer one is, in its fluid's indices.
    std::vector<CellBox> counted_of(int level, int nest) const;
    void regrid(const std::vector<NestPlaces>& places);
    void add_nest(const NestPlaces& places, const std::vector<Nest>& old, bool first);
    int steps_in_one(int level) const { return 1 << (levels() - 1 - level); }

    MPI_Comm comm_;
    RefinedConfig config_;
    std::unique_ptr<Levels> levels_;
    std::int64_t steps_done_ = 0, moves_ = 0;
    std::vector<Vec3> pushed_n_;  // by obstacle, of this rank, in the step of level 0
    bool begun_ = false;  // the coarser levels have done their part of the coming step
};

}  // namespace magfsi::fluid
