// SPDX-License-Identifier: GPL-2.0-or-later
// Obstacles in the flow: their walls after each step, and the force on them. Lattice
// units.
//
// The sweep does not distinguish solid cells: these hold rest and collide as if they were
// fluid. Afterwards the populations that would have come out of a solid cell are replaced
// by those that the wall returns, and the solid cells are set back to rest.
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

#include "fluid_lbm/boundary/sides.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/obstacle/solid_map.h"

namespace magfsi::fluid {

// A lattice link from a fluid cell into an obstacle.
struct CutLink {
    // Slots, by arrangement, of the population of the fluid cell that comes from the
    // obstacle and of the one that goes to it.
    std::ptrdiff_t from_wall[2] = {}, to_wall[2] = {};
    // Distance of the wall from the cell's centre over the link's length; exactly 1/2
    // where the interpolation lacks its second fluid cell, and beside inlets.
    double distance = 0.5;
    signed char push[3] = {};  // direction in which the population strikes
    short obstacle = 0;  // obstacle whose force the link counts in; count() if in none
    short hit = 0;       // obstacle that the link strikes
    std::array<short, 3> cell{};  // local indices of the fluid cell
};

// All links of a rank into obstacles.
struct CutLinks {
    std::vector<CutLink> direct;
    // Links that strike an obstacle after their reflection by a side with free slip. The
    // population that a cell sent to the side comes back to it, half-way; it strikes the
    // obstacle along its mirror image.
    std::vector<CutLink> reflected;
};

// What a fluid cell near an obstacle adds to the flow through a plane beyond its own
// velocity. The sum of the fluid cells' velocities along a line across the plane is what
// the fluid conserves where the wall is half a cell beyond the last of them. At another
// distance d of the wall, where the velocity rises by g per cell, it lacks
//     g (d - 1/2)^2 / 2,
// the integral from the wall to that cell's face (d > 1/2), or the velocity that the cell
// has beyond the wall (d < 1/2). g comes from the cell and the one behind it, (u + u_b) /
// (1 + 2 d), because the cell alone has no accurate g where d is small. To count cells by
// the open share of their face makes the flow worse: their velocity is not its mean.
struct SurfaceShare {
    Cell cell{};   // local indices
    Vec3 share{};  // part of the velocity, by the axis of the line
};

// The obstacles as seen by one rank.
class Obstacles {
  public:
    // Finds the cells and links of this rank; owned: its box.
    Obstacles(const FluidConfig& config, const Solids& solids, const CellBox& owned,
              const Populations& populations, const RowLayout& layout);

    const SolidMap& map() const { return map_; }

    // Notes the populations that free slip reflects into obstacles. To be called after
    // the exchange and before sides change what cells have sent to them. arrangement: the
    // new one.
    void note_sent(const Populations& populations, Arrangement arrangement);
    // Replaces the populations that come from obstacles. To be called after the sides'
    // effects and before outlets; arrangement: the new one. The population that a wall
    // returns is interpolated along the link (Bouzidi et al. 2001). Let d be the wall's
    // distance from the cell A, B the cell behind A, i the direction towards the wall, o
    // the one away from it, and f* the populations that cells have sent; then it is
    //     2 d f*_i(A) + (1 - 2 d) f*_i(B)              for d < 1/2,
    //     f*_i(A) / (2 d) + (1 - 1 / (2 d)) f*_o(A)    else,
    // that is, plain half-way bounce-back at 1/2. The impulse on the body is c_i (f*_i +
    // f_o) (Ladd 1994), with f*_i sent to the wall and f_o returned by it, both minus
    // their weights: the force of gauge pressure. It is exactly the momentum that the
    // fluid loses.
    void bounce(const Populations& populations, Arrangement arrangement);
    // Sets solid cells back to rest. To be called after bounce(), which reads the
    // populations that have arrived there.
    void reset_solid_cells(const Populations& populations, const RowLayout& layout,
                           Arrangement arrangement) const;

    // Impulse of the last step on this rank's links, one entry per obstacle, and a last
    // entry for links that do not count.
    const std::vector<Vec3>& impulses() const { return impulses_; }
    std::size_t count() const { return impulses_.size() - 1; }
    // Makes only links from cells with counts(cell) count in the forces; for a grid that
    // shares its region with coarser or finer ones.
    void count_only(const std::function<bool(const Cell& local)>& counts);

    // Shares of this rank's cells; empty unless FluidConfig::measures_planes.
    const std::vector<SurfaceShare>& surface_shares() const { return shares_; }

    // The solid cells of this rank as rows of local indices.
    const std::vector<CellRow>& rows() const { return rows_; }

  private:
    void find_rows(const RowLayout& layout);
    void add_impulse(const CutLink& link, double populations);

    SolidMap map_;
    CutLinks links_;
    // One per reflected link: the population noted by note_sent().
    std::vector<double> sent_to_slip_;
    std::vector<SurfaceShare> shares_;
    std::vector<CellRow> rows_;
    std::vector<Vec3> impulses_;
};

// Throws std::invalid_argument on all ranks if an obstacle holds the centre of no cell
// that is not an earlier obstacle's, or if all fill the box. Collective.
void check_resolved(MPI_Comm comm, const FluidConfig& config, const SolidMap& map);
// The same check before a run, for the whole box on one process. Also throws if the shape
// of an obstacle is not possible (make_solids), or if an inlet is behind obstacles.
void check_obstacles(const FluidConfig& config);
// Part of the flow that an inlet is asked for which obstacles at the side let into the
// box. map: of the whole box.
double share_past_obstacles(const FluidConfig& config, const SolidMap& map, int side);

}  // namespace magfsi::fluid
