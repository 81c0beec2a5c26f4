// SPDX-License-Identifier: GPL-2.0-or-later
// Mass that crosses the sides of a patch. Both levels beside them know it: what the
// coarse one's populations carried into the covered box, and what the fine one's carried
// into its own. The difference is what the composite of both would gain or lose.
#pragma once

#include "fluid_lbm/refinement/level.h"

namespace magfsi::fluid {

class InterfaceFlux {
  public:
    // box: of the level's cells, the part inside the interface. fine: the patch.
    InterfaceFlux(const Level& level, const CellBox& box, const LevelPlace& fine);
    // By the level's last step, of this rank's cells, in cells of the level at rest.
    double into_box(const Level& level) const;

  private:
    // Slots that follow each other, of populations that have arrived; by arrangement.
    struct Run {
        std::ptrdiff_t first[2] = {};
        int count = 1;
        double factor = 1;  // 1 into the box, -1 out of it
    };
    void add_row(const Level& level, const CellRow& row, bool inside);
    bool crosses(const std::array<int, 3>& cell, int q, bool inside) const;

    CellBox box_;
    std::array<std::array<bool, 2>, 3> open_{}, mirror_{};
    std::array<bool, 3> wraps_{};
    std::vector<Run> runs_;
};

}  // namespace magfsi::fluid
