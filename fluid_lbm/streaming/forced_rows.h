// SPDX-License-Identifier: GPL-2.0-or-later
// Force density of the next step, stored only for the rows that carry one: the rest of
// the box runs the kernel without force. Lattice units.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

template <class Real>
struct ForcePointers {
    const Real* at[3] = {nullptr, nullptr, nullptr};  // null: no force in this row
};

class ForcedRows {
  public:
    // With a body force every row is forced. Stored like the populations: kernels read
    // forces as fast as those.
    ForcedRows(int nx, int ny, int nz, const std::optional<std::array<double, 3>>& body,
               Storage storage);

    // Back to the body force alone.
    void clear();
    // Adds factor * force, three values a cell, to cells x_begin ... of a row of this
    // rank.
    void add(int y, int z, int x_begin, std::span<const double> force, double factor);

    // z * ny + y of the rows with a force of their own, in no order.
    std::span<const int> claimed_rows() const { return claimed_rows_; }

    // Real must be the storage's type.
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
    // Rows begin on cache lines, or vectors would be read from two.
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

    int claim(int row);
    void fill(int slot, const std::array<double, 3>& value);
    void grow();
    // One array per axis: a kernel that prefetches past a row's end prefetches the next
    // one.
    std::size_t line(int slot, int axis) const {
        return (static_cast<std::size_t>(axis) * slots_ + slot) * lines_per_row_;
    }

    int nx_, ny_;
    bool everywhere_;
    std::array<double, 3> body_;
    int first_slot_;  // slot 0 is the body force, if there is one
    std::vector<int> slot_of_row_;
    std::vector<int> claimed_rows_;
    int slots_ = 0;  // there is memory for
    std::size_t lines_per_row_;
    std::variant<Lines<double>, Lines<float>> lines_;  // axis, slot, x
};

}  // namespace magfsi::fluid
