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

    // Real must be the storage's type.
    template <class Real>
    ForcePointers<Real> row(int y, int z) const {
        ForcePointers<Real> p;
        const int slot = slot_of_row_[static_cast<std::size_t>(z) * ny_ + y];
        if (slot == no_force) return p;
        const Real* first = std::get<std::vector<Real>>(values_).data();
        for (int a = 0; a < 3; ++a) p.at[a] = first + offset(slot, a);
        return p;
    }
    std::size_t bytes() const;

  private:
    static constexpr int no_force = -1;
    int claim(int row);
    void fill(int slot, const std::array<double, 3>& value);
    std::size_t offset(int slot, int axis) const {
        return (3 * static_cast<std::size_t>(slot) + axis) * nx_;
    }

    int nx_, ny_;
    bool everywhere_;
    std::array<double, 3> body_;
    int first_slot_;  // slot 0 is the body force, if there is one
    std::vector<int> slot_of_row_;
    std::vector<int> claimed_rows_;
    std::variant<std::vector<double>, std::vector<float>> values_;  // slot, axis, x
};

}  // namespace magfsi::fluid
