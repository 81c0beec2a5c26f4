#include "fluid_lbm/forcing/forced_rows.h"

#include <algorithm>

namespace magfsi::fluid {

namespace {
constexpr int no_force = -1;
constexpr int body_force = 0;
}  // namespace

ForcedRows::ForcedRows(int nx, int ny, int nz,
                       const std::optional<std::array<double, 3>>& body)
    : nx_(nx),
      ny_(ny),
      everywhere_(body.has_value()),
      body_(body.value_or(std::array<double, 3>{})),
      first_slot_(everywhere_ ? 1 : 0),
      slot_of_row_(static_cast<std::size_t>(ny) * nz,
                   everywhere_ ? body_force : no_force) {
    if (everywhere_) fill(body_force, body_);
}

void ForcedRows::fill(int slot, const std::array<double, 3>& value) {
    const std::size_t needed = 3 * (static_cast<std::size_t>(slot) + 1) * nx_;
    if (storage_.size() < needed) storage_.resize(needed);
    for (int axis = 0; axis < 3; ++axis) {
        std::fill_n(slot_component(slot, axis), nx_, value[axis]);
    }
}

void ForcedRows::clear() {
    for (int row : claimed_rows_) slot_of_row_[row] = everywhere_ ? body_force : no_force;
    claimed_rows_.clear();
}

int ForcedRows::claim(int row) {
    int& slot = slot_of_row_[row];
    if (slot < first_slot_) {
        slot = first_slot_ + static_cast<int>(claimed_rows_.size());
        claimed_rows_.push_back(row);
        fill(slot, body_);
    }
    return slot;
}

void ForcedRows::add(int y, int z, int x_begin, std::span<const double> force,
                     double factor) {
    const int slot = claim(z * ny_ + y);
    for (int axis = 0; axis < 3; ++axis) {
        double* to = slot_component(slot, axis) + x_begin;
        for (std::size_t i = 0; i < force.size() / 3; ++i) {
            to[i] += factor * force[3 * i + axis];
        }
    }
}

ForcePointers ForcedRows::row(int y, int z) const {
    ForcePointers p;
    const int slot = slot_of_row_[static_cast<std::size_t>(z) * ny_ + y];
    if (slot == no_force) return p;
    const double* first = storage_.data() + 3 * static_cast<std::size_t>(slot) * nx_;
    for (int axis = 0; axis < 3; ++axis) p.at[axis] = first + axis * nx_;
    return p;
}

std::size_t ForcedRows::bytes() const {
    return storage_.capacity() * sizeof(double) + slot_of_row_.capacity() * sizeof(int);
}

}  // namespace magfsi::fluid
