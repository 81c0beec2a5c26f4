// SPDX-License-Identifier: GPL-2.0-or-later
// The fluid's cells beneath a set of markers, and the sums over them: interpolation
// (eq. 14) and spreading (eq. 15).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/marker_stencil.h"

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
    const Part& part(std::size_t marker) const { return parts_[part_of_[marker]]; }
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

}  // namespace magfsi::coupler
