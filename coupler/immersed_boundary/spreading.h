// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid's cells beneath a set of markers, and the sums over them: interpolation
// (eq. 14) and spreading (eq. 15).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/balance.h"
#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/marker_stencil.h"
#include "coupler/immersed_boundary/no_slip.h"

namespace magfsi::coupler {

// The rows of one rank's cells that markers touch.
class TouchedRows {
  public:
    // boxes: the cells of this rank (Grid::owned_by_rank); markers may reach beyond them,
    // what lies there is left to the rank that owns it.
    TouchedRows(const Grid& grid, const std::vector<CellBox>& boxes, Kernel kernel);

    // Sets the markers by their positions [m].
    void place(std::span<const Vec3> points_m);
    bool placed_at(std::span<const Vec3> points_m) const;

    const std::vector<GridRow>& rows() const { return rows_; }
    std::size_t cells() const { return cells_; }

    // velocity: three values a cell, row after row. Returns this rank's share of each
    // marker's velocity; the shares of all ranks add up.
    void interpolate(std::span<const double> velocity, std::span<Vec3> markers) const;

    // Adds each marker's impulse [N s], given in duration_s, as a force density [N/m3] to
    // the cells.
    void spread(std::span<const Vec3> impulse, double duration_s,
                std::span<double> density) const;

    // to[cell] += factor * values[cell] in the cells that these rows share with `other`,
    // to which the values belong: three a cell, row after row. Both are of the same
    // boxes.
    void add_shared(const TouchedRows& other, std::span<const double> values,
                    double factor, std::span<double> to) const;

  private:
    struct Run {
        int x = 0, cells = 0;
        const double* weight = nullptr;  // of each cell, along x
    };
    using Runs = std::array<Run, max_support>;  // as many in a box of one cell
    struct Part {
        CellBox box;
        int first_slot = 0;
        int slot(int y, int z) const {
            return first_slot + (z - box.lo[2]) * (box.hi[1] - box.lo[1]) +
                   (y - box.lo[1]);
        }
    };
    static constexpr int no_part = -1;
    template <typename Visit>
    void for_each_run(std::size_t marker, Visit&& visit) const;
    template <typename Visit>
    void without_solid(int y, int z, const Run& run, Visit&& visit) const;
    // With the markers' shares in the fluid where there are solid cells.
    template <bool BesideSolid>
    void place_each();
    // The part of which a marker touches cells; with one alone, that.
    int part_of(const MarkerStencil& stencil) const;
    const Part& part(std::size_t marker) const {
        return parts_[static_cast<std::size_t>(part_of_[marker])];
    }
    // Whether the marker touches kernel_ cells along each axis, all of them of this rank,
    // one beside the other.
    bool is_plain(std::size_t marker) const;
    template <typename Use>
    void with_support(Use&& use) const;
    template <int Cells>
    Vec3 read_plain(std::size_t marker, const double* velocity) const;
    template <int Cells>
    void add_plain(std::size_t marker, const Vec3& force, double* density) const;
    std::size_t runs_along_x(const CellBox& box, const Stencil1D& sx, Runs& runs) const;
    // A cell's index from a box's lowest on, across periodic sides.
    int from_box(const CellBox& box, int index, std::size_t axis) const {
        return box.lo[axis] + wrapped(index - box.lo[axis], grid_->cells[axis]);
    }
    std::size_t first_value(int at, int x) const;
    void widen(const Part& part, int y, int z, int x_begin, int x_end);
    void widen_by(std::size_t marker);
    void widen_plain(std::size_t marker);

    const Grid* grid_;
    std::vector<Part> parts_;
    Kernel kernel_;
    SolidCells solid_;
    std::vector<Vec3> points_m_;
    std::vector<MarkerStencil> stencils_;
    std::vector<double> share_;  // of each marker's weights in the fluid
    std::vector<char> plain_;    // of each marker
    std::vector<int> part_of_;   // of each marker
    std::vector<GridRow> rows_;
    std::vector<int> slot_of_;            // of each row
    std::vector<std::ptrdiff_t> origin_;  // of each row: number of its cell x = 0
    std::vector<int> row_of_;             // slot of (y, z) -> row, -1: not touched
    std::size_t cells_ = 0;
};

// The fluid rank's half of the immersed boundary: spreads impulses, samples velocities.
class FluidSide {
  public:
    FluidSide(GridFluid& fluid, const std::vector<CellBox>& owned, Kernel kernel,
              double coupled_step_s, Forcing forcing = Forcing::penalty);

    // The cells of this rank, where the fluid's grid may have moved. True if it has: then
    // nothing is placed.
    bool own(const std::vector<CellBox>& boxes);

    // Gives the impulses [N s] of a step to the fluid as forces over that step. more:
    // besides those of the last spread, at the same points.
    void spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse,
                bool more = false);

    // This rank's share of the velocities at the points.
    std::span<const Vec3> sample(std::span<const Vec3> points_m);

    // The same with half the change of velocity that the last spread's forces will make
    // in the coming step, F dt / (2 rho): the physical velocity of Guo's scheme.
    std::span<const Vec3> sample_forced(std::span<const Vec3> points_m,
                                        double density_kg_m3);

    // For forcing no_slip, after spread() and before sample(): q at the points of the
    // spread, with the velocities sampled there and a force [N/m3] on all of the fluid;
    // after it: the row sums at its points, with the markers' volumes. This rank's
    // shares.
    void add_passed(double density_kg_m3, const Vec3& body_force, NoSlipAnswer& answer);
    void add_row_sums(std::span<const double> volume_m3, NoSlipAnswer& answer);

    // After the fluid's velocities have changed: the next spread reads anew what the last
    // sample has read.
    void fluid_has_changed() { read_now_ = false; }

    // The velocities of the cells that the last sample read, row after row.
    const std::vector<double>& sampled_cells() const { return velocity_; }

    // What this rank's cells received in the last spread: the sums over the cells, not
    // over the markers. Costs a pass over the touched rows.
    InterfaceBalance received();

    // The same where the fluid has moved on since the markers felt it. felt: the
    // sampled_cells() of a sample at the points of the last spread.
    InterfaceBalance received(std::span<const double> felt) const;

  private:
    void read_cells(std::span<const Vec3> points_m);
    std::span<const Vec3> interpolate(std::size_t markers);

    GridFluid& fluid_;
    std::vector<CellBox> owned_;
    Kernel kernel_;
    double coupled_step_s_;
    Forcing forcing_;
    TouchedRows spread_rows_;
    TouchedRows sample_rows_;
    std::vector<double> density_;
    std::vector<double> velocity_;
    bool read_now_ = false;  // velocity_ is that of the fluid as it is
    std::vector<Vec3> sampled_;
    // Of no_slip: the cells' velocities that the markers of the last spread felt.
    std::vector<double> felt_;
    std::vector<Vec3> volume_;  // in the first component
};

}  // namespace magfsi::coupler
