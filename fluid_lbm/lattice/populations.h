// SPDX-License-Identifier: GPL-2.0-or-later
// Storage of the 19 distribution functions of one rank, as f - w (the deviation from
// rest): this keeps about three digits more than f itself at low speeds.
//
// The storage is a full structure of arrays: one array per direction, each made of padded
// rows. One element of padding serves as the ghost on both ends of a row, because a
// direction needs a ghost on one end only. The arrays start a few cache lines apart
// modulo the page, otherwise the 19 streams of a kernel would fall into the same cache
// sets.
//
// In-place streaming (the AA pattern: Bailey et al. 2009) alternates two arrangements:
//   natural: slot q of cell x holds the population q that has arrived at x;
//   swapped: slot opposite(q) of cell x - c_q holds it; behind a wall, slot q of x
//   itself.
// Both are complete states before collision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "fluid_lbm/lattice/d3q19.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

// Kind of the space beyond one side of a rank's box.
enum class Beyond {
    wrap,       // periodic; both ends are on this rank
    wall,       // a side with half-way bounce-back
    neighbour,  // ghost rows, filled by the halo exchange
};

// Numbers of the rows upstream of a row: at[cy + 1][cz + 1] is the row that a population
// with velocity (., cy, cz) comes from, -1 if that lies behind a wall.
struct UpstreamRows {
    int at[3][3];
};

// Layout of the rows of one rank's box, ghost rows included. A row is a line of cells
// along x; rows are never cut between ranks.
struct RowLayout {
    int nx = 0, ny = 0, nz = 0;                    // owned cells
    Beyond beyond_x = Beyond::wrap;                // both ends alike, never neighbour
    std::array<Beyond, 2> beyond_y{}, beyond_z{};  // low and high side

    // Number of ghost rows on each side of the box, 0 or 1.
    int margin_y() const { return margin(beyond_y); }
    int margin_z() const { return margin(beyond_z); }
    static int margin(const std::array<Beyond, 2>& sides) {
        return sides[0] == Beyond::neighbour || sides[1] == Beyond::neighbour ? 1 : 0;
    }

    int row_count() const { return (ny + 2 * margin_y()) * (nz + 2 * margin_z()); }
    // Number of the row at (y, z), with y in [-margin_y, ny + margin_y) and z alike.
    int row(int y, int z) const {
        return (z + margin_z()) * (ny + 2 * margin_y()) + y + margin_y();
    }
    UpstreamRows upstream(int y, int z) const;
};

// Index that a step beyond a side leads to: unchanged inside the box and in ghost rows,
// the other end across a periodic side; meaningless if `wall` is set.
struct Crossing {
    int index = 0;
    bool wall = false;
};
// Resolves an index of -1 ... count along an axis of `count` cells with these two sides.
Crossing cross(int index, int count, const std::array<Beyond, 2>& sides);

// Arrangement of the populations in memory, described at the top of this file.
enum class Arrangement { natural, swapped };
// The arrangement after a number of steps from rest.
inline Arrangement arrangement_after(std::int64_t steps) {
    return steps % 2 == 0 ? Arrangement::natural : Arrangement::swapped;
}

// The rows of populations as numbers of one type. It is a view on memory: const does not
// protect the values.
template <class Real>
class PopulationRows {
  public:
    PopulationRows(Real* first, std::ptrdiff_t array_stride, std::ptrdiff_t row_stride)
        : first_(first), array_stride_(array_stride), row_stride_(row_stride) {}

    // Pointer to element 0 of a row, 64-byte aligned; elements -1 and row_length may be
    // used too, as ghosts.
    Real* row(int q, int row) const {
        return first_ + q * array_stride_ + row * row_stride_;
    }

  private:
    Real* first_;
    std::ptrdiff_t array_stride_, row_stride_;
};

// The 19 arrays of one rank's populations and their memory. Not copyable.
class Populations {
  public:
    // Allocates row_count rows of row_length cells, at rest with density 1. The threads
    // first touch those rows that the sweep will give them. Throws std::bad_alloc.
    Populations(int row_length, int row_count, Precision precision);

    // Memory [bytes] of such an object, padding included.
    static std::size_t bytes_of(int row_length, int row_count, Precision precision);

    // Calls use(rows) with rows of the stored type, PopulationRows<double> or
    // PopulationRows<float>. All code outside the kernels reads and writes populations
    // so.
    template <class Use>
    decltype(auto) visit(Use&& use) const {
        if (precision_ == Precision::float_) return use(rows<float>());
        return use(rows<double>());
    }
    // The rows of the stored type, which Real must be.
    template <class Real>
    PopulationRows<Real> rows() const {
        return {static_cast<Real*>(first_), array_stride_, row_stride_};
    }

    std::size_t element_bytes() const {
        return precision_ == Precision::float_ ? sizeof(float) : sizeof(double);
    }
    std::ptrdiff_t row_stride() const { return row_stride_; }  // elements
    std::size_t bytes() const { return bytes_; }
    // The whole memory, padding included, to save and restore a state.
    std::span<std::byte> all_bytes() const {
        return {static_cast<std::byte*>(memory_.get()), bytes_};
    }
    // Address that offset() counts from, the first element of row 0 of direction 0.
    void* memory() const { return first_; }
    std::ptrdiff_t offset(int q, int row) const {  // bytes from memory()
        return (q * array_stride_ + row * row_stride_) *
               static_cast<std::ptrdiff_t>(element_bytes());
    }

  private:
    struct Free {
        std::size_t bytes;
        void operator()(void* memory) const;
    };
    static std::unique_ptr<void, Free> allocate(std::size_t bytes);

    Precision precision_;
    std::ptrdiff_t row_stride_ = 0, array_stride_ = 0;  // elements
    std::size_t bytes_ = 0;
    std::unique_ptr<void, Free> memory_;
    void* first_ = nullptr;
};

// Makes later objects reuse the memory of destroyed ones, until the process ends. A patch
// of a refined grid that moves is made anew, and two thirds of a move's time went to the
// system, which clears fresh pages. Not safe to call beside other threads.
void keep_memory_of_populations();

// Pointers to the slots that one row reads and writes in one step. at[q] points to the
// slot of the population q that arrives at cell 0 of the row; the kernel writes the
// outgoing population q to at[opposite(q)]. Every slot belongs to one row only, so rows
// may be computed in any order.
template <class Real>
struct RowPointers {
    Real* at[d3q19::directions];
    Real* own[d3q19::directions];     // slot q of the row itself
    bool bounced[d3q19::directions];  // the population comes from a wall along y or z
};

// Pointers of the row (y, z) in the natural arrangement: all slots are in the row itself.
template <class Real>
RowPointers<Real> natural_pointers(const PopulationRows<Real>& rows,
                                   const RowLayout& layout, int y, int z) {
    RowPointers<Real> p;
    const int row = layout.row(y, z);
    for (int q = 0; q < d3q19::directions; ++q) {
        p.at[q] = p.own[q] = rows.row(q, row);
        p.bounced[q] = false;
    }
    return p;
}

// Pointers of the row (y, z) in the swapped arrangement: the slot of population q is in
// the row upstream, shifted by c_q along x, or in the row itself behind a wall. Inner
// rows take a shorter way that needs no test of the sides.
template <class Real>
RowPointers<Real> swapped_pointers(const PopulationRows<Real>& rows,
                                   const RowLayout& layout, int y, int z) {
    using namespace d3q19;
    RowPointers<Real> p;
    const int row = layout.row(y, z);
    if (y > 0 && y < layout.ny - 1 && z > 0 && z < layout.nz - 1) {
        const int plane = layout.row(y, z + 1) - row;
#pragma GCC unroll 19
        for (int q = 0; q < directions; ++q) {
            p.own[q] = rows.row(q, row);
            p.bounced[q] = false;
            p.at[q] = rows.row(opposite(q), row - c[q][1] - c[q][2] * plane) - c[q][0];
        }
        return p;
    }
    const UpstreamRows upstream = layout.upstream(y, z);
    for (int q = 0; q < directions; ++q) {
        const int from = upstream.at[c[q][1] + 1][c[q][2] + 1];
        p.own[q] = rows.row(q, row);
        p.bounced[q] = from < 0;
        p.at[q] = from < 0 ? p.own[q] : rows.row(opposite(q), from) - c[q][0];
    }
    return p;
}

// Pointers of the row (y, z) in the given arrangement.
template <class Real>
RowPointers<Real> pointers(const PopulationRows<Real>& rows, const RowLayout& layout,
                           Arrangement arrangement, int y, int z) {
    return arrangement == Arrangement::natural ? natural_pointers(rows, layout, y, z)
                                               : swapped_pointers(rows, layout, y, z);
}

// The two ends of a row in the swapped arrangement. Populations with a velocity along x
// that enter the row there are read and written by the kernel in a ghost element. Its
// partner is the other end of the same array (periodic) or the row's own slot (half-way
// bounce-back). Walls along y and z need no such step: swapped_pointers() substitutes the
// row's pointer.
// open_x_ends copies each partner's value into the ghost element, before the kernel.
template <class Real>
void open_x_ends(const RowPointers<Real>& p, const RowLayout& layout);
// Prefetches the elements that open_x_ends will read in the next row, `shift` elements
// further on: one cache line per population, at the far end of a row.
template <class Real>
void prefetch_x_ends(const RowPointers<Real>& p, const RowLayout& layout,
                     std::ptrdiff_t shift) {
    for (int q = 1; q < d3q19::directions; ++q) {
        if (d3q19::c[q][0] == 0) continue;
        __builtin_prefetch(p.at[q] + shift + (d3q19::c[q][0] > 0 ? layout.nx : -1), 1, 3);
    }
}
// Copies each ghost element's value back to its partner, after the kernel.
template <class Real>
void close_x_ends(const RowPointers<Real>& p, const RowLayout& layout);
// Replaces open_x_ends and close_x_ends where the values that arrive at the ends do not
// matter: sets the ghost elements to fluid at rest. The cache lines are those that the
// kernel is about to read.
template <class Real>
void rest_x_ends(const RowPointers<Real>& p, const RowLayout& layout);

// Slots of a single cell, for boundaries and obstacles, which touch few cells and keep
// lists of slots.
//
// All boundary code rests on two facts. After the sweep and the exchange
//   - population q that arrived in a cell is at slot(q) of the new arrangement; behind a
//     wall side that is the cell's own array q in both arrangements, and it holds the
//     cell's outgoing population opposite(q): half-way bounce-back;
//   - the outgoing population q of a cell is still at slot(opposite(q)) of the old
//     arrangement, as long as nothing has overwritten the population that arrived at its
//     destination.

// Offsets of a cell's 19 slots from rows.row(0, 0), in elements, by direction.
using CellSlots = std::array<std::ptrdiff_t, d3q19::directions>;

// The slots of the populations that have arrived in a cell (local indices), ends of rows
// included.
template <class Real>
CellSlots cell_slots(const PopulationRows<Real>& rows, const RowLayout& layout,
                     Arrangement arrangement, const std::array<int, 3>& cell) {
    const RowPointers<Real> p = pointers(rows, layout, arrangement, cell[1], cell[2]);
    const Real* const base = rows.row(0, 0);
    CellSlots slots;
    for (int q = 0; q < d3q19::directions; ++q) {
        const Real* at = p.at[q] + cell[0];
        const int from = cell[0] - d3q19::c[q][0];
        const bool beyond = from < 0 || from >= layout.nx;
        if (arrangement == Arrangement::swapped && beyond && !p.bounced[q]) {
            at = layout.beyond_x == Beyond::wall
                     ? p.own[q] + cell[0]
                     : at + (from < 0 ? layout.nx : -layout.nx);
        }
        slots[q] = at - base;
    }
    return slots;
}

}  // namespace magfsi::fluid
