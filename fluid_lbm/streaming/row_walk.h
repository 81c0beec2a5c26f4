// The pointers of row after row. Away from the box's sides they move in step, so that one
// pattern, shifted, serves all inner rows: building each from the layout took 5 % of a
// step in float.
#pragma once

#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

template <class Real>
class RowWalk {
  public:
    RowWalk(const PopulationRows<Real>& rows, const RowLayout& layout,
            Arrangement arrangement, std::ptrdiff_t row_stride)
        : rows_(rows),
          layout_(layout),
          arrangement_(arrangement),
          row_stride_(row_stride),
          pattern_row_(layout.row(1, 1)) {
        if (layout.ny > 2 && layout.nz > 2) {
            pattern_ = pointers(rows, layout, arrangement, 1, 1);
        }
    }

    RowPointers<Real> at(int y, int z) const {
        const bool inner = y > 0 && y < layout_.ny - 1 && z > 0 && z < layout_.nz - 1;
        if (!inner) return pointers(rows_, layout_, arrangement_, y, z);
        const std::ptrdiff_t shift = (layout_.row(y, z) - pattern_row_) * row_stride_;
        RowPointers<Real> p = pattern_;
        for (int q = 0; q < d3q19::directions; ++q) {
            p.at[q] += shift;
            p.own[q] += shift;
        }
        return p;
    }

  private:
    const PopulationRows<Real>& rows_;
    const RowLayout& layout_;
    Arrangement arrangement_;
    std::ptrdiff_t row_stride_;
    int pattern_row_;
    RowPointers<Real> pattern_{};
};

}  // namespace magfsi::fluid
