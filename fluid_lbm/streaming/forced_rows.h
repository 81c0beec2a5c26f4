// SPDX-License-Identifier: GPL-2.0-or-later
// Force density of the next step, stored only for the rows that carry one; all other rows
// run the kernel without force. Lattice units.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "base/vector/vec3.h"
#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

// Pointers to the three components of the force in a row, indexed by x.
template <class Real>
struct ForcePointers {
    const Real* at[3] = {nullptr, nullptr, nullptr};  // all null: the row has no force
};

// The forces of one rank's rows. Storage grows with the rows that carry a force.
class ForcedRows {
  public:
    // nx, ny, nz: the rank's cells. body: the body force, which acts in all rows; absent:
    // rows are free of force until add(). Forces are stored in the type of the
    // populations, so that kernels read both alike.
    ForcedRows(int nx, int ny, int nz, const std::optional<Vec3>& body,
               Precision precision);

    // Removes all forces but the body force.
    void clear();
    // Adds factor * force to the cells x_begin, x_begin + 1, ... of the row (y, z) of
    // this rank; force: three values per cell.
    void add(int y, int z, int x_begin, std::span<const double> force, double factor);

    // Numbers z * ny + y of the rows with a force beyond the body force, in no order.
    std::span<const int> claimed_rows() const { return claimed_rows_; }

    // Pointers to the force in a row. Real must be the type of the storage.
    template <class Real>
    ForcePointers<Real> row(int y, int z) const {
        ForcePointers<Real> p;
        const int slot = slot_of_row_[static_cast<std::size_t>(z) * ny_ + y];
        if (slot == no_force) return p;
        const auto& lines = std::get<Lines<Real>>(lines_);
        for (int a = 0; a < 3; ++a)
            p.at[a] = values(lines) + line(slot, a) * per_line<Real>;
        return p;
    }

  private:
    static constexpr int no_force = -1;
    // Number of values in a cache line. Rows begin on cache lines, otherwise a vector
    // could straddle two.
    template <class Real>
    static constexpr std::size_t per_line = 64 / sizeof(Real);
    template <class Real>
    struct alignas(64) Line {
        Real values[per_line<Real>];
    };
    template <class Real>
    using Lines = std::vector<Line<Real>>;
    template <class Real>
    static const Real* values(const Lines<Real>& lines) {
        return reinterpret_cast<const Real*>(lines.data());
    }
    template <class Real>
    Real* values(Lines<Real>& lines, int slot, int axis) {
        return reinterpret_cast<Real*>(lines.data()) + line(slot, axis) * per_line<Real>;
    }

    // Slot of a row's force; a new one, filled with the body force, if the row has none.
    int claim(int row);
    void fill(int slot, const Vec3& value);
    // Doubles the number of slots.
    void grow();
    // Number of the line where a slot begins. There is one array per axis, so that a
    // kernel that prefetches beyond a row's end prefetches the next row.
    std::size_t line(int slot, int axis) const {
        return (static_cast<std::size_t>(axis) * slots_ + slot) * lines_per_row_;
    }

    int nx_, ny_;
    bool everywhere_;
    Vec3 body_;
    // First slot that rows can claim; slot 0 is the body force, if there is one.
    int first_slot_;
    std::vector<int> slot_of_row_;  // no_force where a row has none
    std::vector<int> claimed_rows_;
    int slots_ = 0;  // number of slots that memory is allocated for
    std::size_t lines_per_row_;
    std::variant<Lines<double>, Lines<float>> lines_;  // [axis][slot][x]
};

}  // namespace magfsi::fluid
