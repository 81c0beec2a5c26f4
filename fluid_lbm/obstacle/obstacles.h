// Obstacles in the flow: what they do after each step, and the force on them. Lattice
// units.
//
// The sweep knows nothing of them: solid cells hold rest and collide as if they were
// fluid. Afterwards the populations that would have come out of a solid cell are replaced
// by those that the wall returns, and the solid cells are set back to rest.
#pragma once

#include <vector>

#include "fluid_lbm/obstacle/cut_links.h"

namespace magfsi::fluid {

class Obstacles {
  public:
    // owned: this rank's box.
    Obstacles(const Solids& solids, const CellBox& owned,
              const std::array<int, 3>& box_cells, const std::array<bool, 3>& periodic,
              const LinkOptions& options, const Populations& populations,
              const RowLayout& layout);

    const SolidMap& map() const { return map_; }
    std::size_t bytes() const;

    // After the exchange and before sides with free slip exchange what they reflect.
    void look(const Populations& populations, Arrangement arrangement);
    // After the sides, before outlets; arrangement: the new one. With d the wall's
    // distance over the link, f*_i what the cell sent to the wall, f*_o what it sent the
    // other way and f_i what has now arrived from there, the wall returns (Bouzidi et al.
    // 2001)
    //   2 d f*_i + (1 - 2 d) f_i                      for d < 1/2,
    //   f*_i / (2 d) + (1 - 1 / (2 d)) f*_o           else,
    // plain half-way bounce-back f*_i at d = 1/2. The impulse on the body is
    // c_i (f*_i + f_o) (Ladd 1994), f minus weight: gauge pressure. It is exactly what
    // the fluid loses.
    void bounce(const Populations& populations, Arrangement arrangement);
    // Solid cells back to rest. After bounce(), which reads what has arrived there.
    void settle(const Populations& populations, const RowLayout& layout,
                Arrangement arrangement) const;

    // Impulse of the last step on this rank's links, by obstacle.
    const std::vector<Vec3>& impulses() const { return impulses_; }

  private:
    struct Run {
        int x_begin, x_end, y, z;
    };

    void find_runs(const RowLayout& layout);
    void strike(const CutLink& link, double populations);

    SolidMap map_;
    CutLinks links_;
    std::vector<double> sent_to_slip_;  // by reflected link
    std::vector<Run> runs_;
    std::vector<Vec3> impulses_;
};

}  // namespace magfsi::fluid
