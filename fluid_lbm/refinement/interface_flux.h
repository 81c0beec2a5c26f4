// SPDX-License-Identifier: GPL-2.0-or-later
// Mass that crosses the sides of a patch. Both levels give a value for it: the mass that
// the coarse populations carry into the covered box, and the mass that the fine ones
// carry into the patch. Their difference is the mass that the composite of both would
// gain or lose.
#pragma once

#include "fluid_lbm/refinement/level.h"

namespace magfsi::fluid {

// Mass through the interface according to one level's populations.
class InterfaceFlux {
  public:
    // level: the level whose populations are counted; box: its cells inside the
    // interface; fine: the patch.
    InterfaceFlux(const Level& level, const CellBox& box, const LevelPlace& fine);
    // Mass that the level's last step has carried into the box through this rank's cells,
    // in cells of the level at rest.
    double into_box(const Level& level) const;

  private:
    // A run of slots, by arrangement, of populations that have crossed the interface.
    struct Run {
        std::ptrdiff_t first[2] = {};
        int count = 1;
        double factor = 1;  // 1 into the box, -1 out of it
    };
    // Adds the runs of a row of cells beside the interface; inside: the row lies in the
    // box.
    void add_row(const Level& level, const CellRow& row, bool inside);
    bool crosses(const std::array<int, 3>& cell, int q, bool inside) const;

    CellBox box_;
    // [axis][end]: interface there, free slip there
    std::array<std::array<bool, 2>, 3> open_{}, mirror_{};
    std::array<bool, 3> wraps_{};  // axes that the patch covers from end to end
    std::vector<Run> runs_;
};

}  // namespace magfsi::fluid
