// SPDX-License-Identifier: GPL-2.0-or-later
// The cells that a set of markers touches, and the sums over them: interpolation (eq. 14)
// and spreading (eq. 15).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/marker_stencil.h"

namespace magfsi::coupler {

// The rows of one rank's cells that markers touch. Cell values are lists over the cells
// of these rows, row after row, three numbers per cell. The grid must outlive this
// object.
class TouchedRows {
  public:
    // boxes: the cells of this rank (Grid::owned_by_rank). Markers may reach beyond them;
    // the part of their weights there belongs to other ranks.
    TouchedRows(const Grid& grid, const std::vector<CellBox>& boxes, Kernel kernel);

    // Places the markers at their positions [m], which determines the rows. Throws
    // Diverged if one lies outside the box.
    void place(std::span<const Vec3> points_m);
    // True if the markers were last placed at exactly these points.
    bool placed_at(std::span<const Vec3> points_m) const;

    // The touched rows, in the order of cell values, and their number of cells.
    const std::vector<GridRow>& rows() const { return rows_; }
    std::size_t cells() const { return cells_; }

    // Computes this rank's share of each marker's velocity from the cells' velocities
    // [m/s]; the shares of all ranks add up.
    void interpolate(std::span<const double> velocity, std::span<Vec3> markers) const;

    // Adds each marker's impulse [N s], given over duration_s [s], as a force density
    // [N/m3] to the cells.
    void spread(std::span<const Vec3> impulse, double duration_s,
                std::span<double> density) const;

  private:
    // Cells of a stencil side by side along x, with one weight each.
    struct Run {
        int x = 0, cells = 0;
        const double* weight = nullptr;
    };
    using Runs = std::array<Run, max_support>;  // one cell each at worst
    // One box of this rank. A slot numbers a pair (y, z), counted over all boxes.
    struct Part {
        CellBox box;
        int first_slot = 0;
        int slot(int y, int z) const {
            return first_slot + (z - box.lo[2]) * (box.hi[1] - box.lo[1]) +
                   (y - box.lo[1]);
        }
    };
    static constexpr int no_part = -1;  // the marker touches none of this rank's cells
    template <typename Visit>
    void for_each_run(std::size_t marker, Visit&& visit) const;
    template <typename Visit>
    void without_solid(int y, int z, const Run& run, Visit&& visit) const;
    // Computes stencils, rows and, if BesideSolid, the markers' shares in the fluid.
    template <bool BesideSolid>
    void place_each();
    // Number of the box with cells that a marker touches, or no_part. With one box it is
    // always that box.
    int part_of(const MarkerStencil& stencil) const;
    const Part& part(std::size_t marker) const { return parts_[part_of_[marker]]; }
    // True if the marker's stencil has its full support along each axis, lies in one box
    // of this rank and does not wrap. Such markers take the fast loops.
    bool is_plain(std::size_t marker) const;
    template <typename Use>
    void with_support(Use&& use) const;
    template <int Cells>
    Vec3 read_plain(std::size_t marker, const double* velocity) const;
    template <int Cells>
    void add_plain(std::size_t marker, const Vec3& force, double* density) const;
    std::size_t runs_along_x(const CellBox& box, const Stencil1D& sx, Runs& runs) const;
    // Index of a cell counted upwards from the lowest cell of a box, across periodic
    // sides.
    int from_box(const CellBox& box, int index, std::size_t axis) const {
        return box.lo[axis] + wrapped(index - box.lo[axis], grid_->cells[axis]);
    }
    // Index in the cell values of cell x in the row of a slot.
    std::size_t first_value(int at, int x) const;
    // Extend the rows so that they hold given cells, or those of a marker.
    void widen(const Part& part, int y, int z, int x_begin, int x_end);
    void widen_by(std::size_t marker);
    void widen_plain(std::size_t marker);

    const Grid* grid_;
    std::vector<Part> parts_;
    Kernel kernel_;
    SolidCells solid_;
    std::vector<Vec3> points_m_;
    std::vector<MarkerStencil> stencils_;
    std::vector<double> share_;  // weights in fluid cells, by marker
    std::vector<char> plain_;    // is_plain, by marker
    std::vector<int> part_of_;   // number of the box, by marker
    std::vector<GridRow> rows_;
    std::vector<int> slot_of_;  // slot of each row
    // For each row the index of its cell x = 0, if it had one, among the cells.
    std::vector<std::ptrdiff_t> origin_;
    std::vector<int> row_of_;  // row of each slot, -1 if not touched
    std::size_t cells_ = 0;
};

}  // namespace magfsi::coupler
