// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/streaming/forced_rows.h"

#include <algorithm>
#include <utility>

namespace magfsi::fluid {

namespace {
constexpr int body_force = 0;
}  // namespace

ForcedRows::ForcedRows(int nx, int ny, int nz, const std::optional<Vec3>& body,
                       Precision precision)
    : nx_(nx),
      ny_(ny),
      everywhere_(body.has_value()),
      body_(body.value_or(Vec3{})),
      first_slot_(everywhere_ ? 1 : 0),
      slot_of_row_(static_cast<std::size_t>(ny) * nz,
                   everywhere_ ? body_force : no_force) {
    if (precision == Precision::float_) lines_.emplace<Lines<float>>();
    lines_per_row_ = std::visit(
        [&]<class Real>(const Lines<Real>&) { return (nx - 1) / per_line<Real> + 1; },
        lines_);
    if (everywhere_) fill(body_force, body_);
}

void ForcedRows::grow() {
    const int before = slots_;
    slots_ = std::max(16, 2 * before);
    std::visit(
        [&]<class Real>(Lines<Real>& lines) {
            Lines<Real> grown(line(0, 3));
            const std::size_t used = before * lines_per_row_;
            for (int a = 0; a < 3; ++a)
                std::copy_n(lines.begin() + a * used, used, grown.begin() + line(0, a));
            lines = std::move(grown);
        },
        lines_);
}

void ForcedRows::fill(int slot, const Vec3& value) {
    if (slot >= slots_) grow();
    std::visit(
        [&]<class Real>(Lines<Real>& lines) {
            for (int a = 0; a < 3; ++a)
                std::fill_n(values(lines, slot, a), nx_, static_cast<Real>(value[a]));
        },
        lines_);
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
    std::visit(
        [&]<class Real>(Lines<Real>& lines) {
            for (int a = 0; a < 3; ++a) {
                Real* to = values(lines, slot, a) + x_begin;
                for (std::size_t i = 0; i < force.size() / 3; ++i) {
                    to[i] = static_cast<Real>(to[i] + factor * force[3 * i + a]);
                }
            }
        },
        lines_);
}

}  // namespace magfsi::fluid
