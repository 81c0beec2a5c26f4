// SPDX-License-Identifier: GPL-2.0-or-later
// A fluid with finer patches over its uniform grid (refinement/patch.h). One step is one
// of the finest level; a level steps in every second step of the next finer one. Forces
// act in cells of the finest level alone.
//
//   before the steps 0, 2, 4, ... of a level  its ring is filled from the level below,
//                                             which then takes its own step
//   after the steps 1, 3, 5, ...              the level below is overwritten where it is
//                                             covered
//
// SI; cells of the finest level count from the corner of the whole box.
#pragma once

#include "fluid_lbm/fluid.h"
#include "fluid_lbm/refinement/patch.h"

namespace magfsi::fluid {

struct RefinedConfig {
    FluidConfig coarse;  // its time step: 2^levels steps
    PatchRule rule{};
    int least_margin_cells = 0;    // that bodies must keep in a patch that stays
    bool obstacle_forces = false;  // somebody reads them
};

class RefinedFluid {
  public:
    // Patches around bodies in that box [m]. Throws std::invalid_argument on a
    // configuration that cannot run.
    RefinedFluid(MPI_Comm comm, const RefinedConfig& config,
                 const std::array<Vec3, 2>& bodies_m);
    ~RefinedFluid();
    RefinedFluid(const RefinedFluid&) = delete;
    RefinedFluid& operator=(const RefinedFluid&) = delete;

    const RefinedConfig& config() const { return config_; }
    int levels() const;  // with level 0
    const Fluid& level(int number) const;
    const LevelPlace& place(int number) const;
    std::vector<LevelPlace> finer_places() const;

    // Cells of the finest level that each rank solves: the patch, without its ring.
    std::vector<CellBox> owned_by_rank() const { return inside_by_rank(levels() - 1); }
    std::vector<CellBox> inside_by_rank(int level) const;
    // As of Fluid, in those cells.
    void velocity(std::span<const CellRow> rows, std::span<double> out) const;
    void set_force(std::span<const CellRow> rows, std::span<const double> force);
    void step();
    void keep();
    void go_back();
    double waited_for_neighbours_s() const;
    std::optional<Divergence> diverged() const;

    // Moves and resizes the patches if the bodies in that box [m] come near their sides.
    // Only between steps after which all levels stand at one time. True if it did.
    // Collective.
    bool follow(const std::array<Vec3, 2>& bodies_m);
    bool levels_are_level() const;  // all stand at one time
    std::int64_t moves() const { return moves_; }
    // From step to step levels are given only those covered cells that they need; now
    // all, for somebody who reads them. Changes nothing in coming steps. Collective.
    void cover_all();

    // Each place of the box counts once, with the finest level there. Collective.
    Totals totals() const;
    double enstrophy_1_s2() const;
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
    void restore(std::int64_t steps, const std::vector<LevelPlace>& finer,
                 const std::vector<double>& kept_mass);
    Fluid& level(int number);

  private:
    struct Levels;
    void begin_step();
    void step_level(int number);
    void end_step();
    double excess_of_finer() const;
    void count_links_once();
    void add_pushes(int number, double sign);
    // Boxes of a level where no finer one is, in its fluid's indices.
    std::vector<CellBox> counted_of(int level) const;
    void regrid(const std::vector<LevelPlace>& places);
    int steps_in_one(int level) const { return 1 << (levels() - 1 - level); }

    MPI_Comm comm_;
    RefinedConfig config_;
    std::unique_ptr<Levels> levels_;
    std::int64_t steps_done_ = 0, moves_ = 0;
    std::vector<Vec3> pushed_n_;  // by obstacle, of this rank, in the step of level 0
    bool begun_ = false;  // the coarser levels have done their part of the coming step
};

}  // namespace magfsi::fluid
