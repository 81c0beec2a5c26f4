// SPDX-License-Identifier: GPL-2.0-or-later
// The state at the start of a step that is taken again with other forces in the same
// rows. Where nothing but the sweep changes populations, the forced rows alone differ
// from one time to the next, and in-place streaming lets a row be swept again by itself
// (every slot belongs to one row only): they are all that is kept and swept again. Else,
// with inlets, outlets, moving walls or obstacles, it is the whole state.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/sampling/moments.h"

namespace magfsi::fluid {

class KeptState {
  public:
    // The same on all ranks.
    explicit KeptState(bool rows_suffice) : rows_suffice_(rows_suffice) {}

    // The coming step may be taken again.
    void keep(const View& now);
    // Before its first sweep. forced_rows: z * ny + y.
    void note_rows(const View& now, std::span<const int> forced_rows);
    // before: the arrangement and place of what was kept.
    void put_back(const View& before) const;

    // The rows that are to be swept again, or nothing where it is all of them.
    bool by_rows() const { return rows_suffice_; }
    std::span<const RowBox> rows() const { return rows_; }
    bool has(int y, int z) const;

  private:
    bool rows_suffice_;
    bool waiting_ = false;  // for the rows of the step that is to be kept
    std::vector<RowBox> rows_;
    std::vector<double> values_;    // row, population, x
    std::vector<std::byte> whole_;  // all populations
};

}  // namespace magfsi::fluid
