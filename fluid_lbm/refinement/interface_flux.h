// Mass that crosses the sides of a patch. Both levels beside them know it: what the coarse
// one's populations carried into the covered box, and what the fine one's carried into its
// own. The difference is what the composite of both would gain or lose.
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
    struct Row {
        CellRow cells;  // of this rank
        std::size_t end = 0;
    };
    void add_row(const Level& level, const CellRow& row, bool inside);
    bool crosses(const std::array<int, 3>& cell, int q, bool inside) const;

    CellBox box_;
    std::array<std::array<bool, 2>, 3> open_{}, mirror_{};
    std::array<bool, 3> wraps_{};
    std::vector<Row> rows_;
    std::vector<PopulationRun> runs_;
};

}  // namespace magfsi::fluid
