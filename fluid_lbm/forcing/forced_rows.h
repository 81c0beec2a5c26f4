// Force density of the next step, stored only for the rows that carry one: the rest of
// the box runs the kernel without force. Lattice units.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace magfsi::fluid {

struct ForcePointers {
    const double* at[3] = {nullptr, nullptr, nullptr};  // null: no force in this row
};

class ForcedRows {
  public:
    // With a body force every row is forced.
    ForcedRows(int nx, int ny, int nz, const std::optional<std::array<double, 3>>& body);

    // Back to the body force alone.
    void clear();
    // Adds factor * force, three values a cell, to cells x_begin ... of a row of this
    // rank.
    void add(int y, int z, int x_begin, std::span<const double> force, double factor);

    ForcePointers row(int y, int z) const;
    std::size_t bytes() const;

  private:
    int claim(int row);
    void fill(int slot, const std::array<double, 3>& value);
    double* slot_component(int slot, int axis) {
        return storage_.data() + (3 * static_cast<std::size_t>(slot) + axis) * nx_;
    }

    int nx_, ny_;
    bool everywhere_;
    std::array<double, 3> body_;
    int first_slot_;  // slot 0 is the body force, if there is one
    std::vector<int> slot_of_row_;
    std::vector<int> claimed_rows_;
    std::vector<double> storage_;  // slot, axis, x
};

}  // namespace magfsi::fluid
