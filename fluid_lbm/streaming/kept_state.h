// SPDX-License-Identifier: GPL-2.0-or-later
// The state at the start of a step that is repeated with other forces in the same rows.
// Where nothing but the sweep changes populations, only the forced rows differ from one
// repetition to the next, and in-place streaming lets a row be swept again by itself
// (every slot belongs to one row only). It then suffices to keep and to sweep these rows.
// Otherwise, with inlets, outlets, moving walls or obstacles, the whole state is kept.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/sampling/moments.h"

namespace magfsi::fluid {

// The copy of one rank's state, and the way back to it.
class KeptState {
  public:
    // rows_suffice: true if forced rows alone are to be kept; must be the same on all
    // ranks.
    explicit KeptState(bool rows_suffice) : rows_suffice_(rows_suffice) {}

    // Notes that the coming step may be repeated, and copies the state if all of it is
    // kept.
    void keep(const View& now);
    // Copies the forced rows (numbers z * ny + y). Must be called before the first sweep
    // of that step; does nothing unless keep() was called.
    void note_rows(const View& now, std::span<const int> forced_rows);
    // Writes the kept state back. before: a view in the arrangement that was kept.
    void put_back(const View& before) const;

    // True if a repetition sweeps only rows(), false if it sweeps all rows.
    bool by_rows() const { return rows_suffice_; }
    std::span<const RowBox> rows() const { return rows_; }
    // True if rows() contains the row (y, z).
    bool has(int y, int z) const;

  private:
    bool rows_suffice_;
    bool waiting_ = false;  // true between keep() and note_rows()
    std::vector<RowBox> rows_;
    std::vector<double> values_;    // kept rows: [row][population][x]
    std::vector<std::byte> whole_;  // kept state, if all of it is kept
};

}  // namespace magfsi::fluid
