// Sides that let flow and sound out. In one dimension the flow carries two
// characteristics; p + cs u_n leaves with what streams to the side, p - cs u_n enters.
// The entering one is kept constant but for a slow pull of the pressure to its target
// (Poinsot and Lele 1992; u_n along the outward normal, rho0 = 1):
//   (p - cs u_n)(t + 1) = (p - cs u_n)(t) - k (p(t) - p_target),  k = 0.25 cs / L.
// A fixed pressure would reflect sound fully, a fixed velocity too. The populations that
// have streamed to a cell know rho + rho u_n exactly (Zou and He 1997): both follow. All
// 19 are then rebuilt from rho, u and the stress, with the bounce-back of the
// non-equilibrium part for the unknown ones (regularised: Latt et al. 2008), which stays
// stable close to relaxation time 1/2. The tangential velocity is that of the next cell
// inwards.
#pragma once

#include <vector>

#include "fluid_lbm/boundary/lattice_side.h"
#include "fluid_lbm/boundary/slots.h"

namespace magfsi::fluid {

class PressureOutlet {
  public:
    // cells: this rank's open cells at the side, local indices; length: L, the box's
    // cells along the side's axis.
    PressureOutlet(const LatticeSide& side, int side_index,
                   const std::vector<Cell>& cells, int length,
                   const Populations& populations, const RowLayout& layout);

    // Before the sweep: what enters in the coming step.
    void look(const Populations& populations, Arrangement arrangement);
    // After all else has been applied to the cells, in the new arrangement.
    void apply(const Populations& populations, Arrangement arrangement) const;

  private:
    struct OpenCell {
        CellSlots slots[2], inner_slots[2];  // by arrangement
        double entering = 0;                 // p - cs u_n
    };

    int axis_, outward_;
    double target_pressure_, pull_;
    std::vector<OpenCell> cells_;
};

}  // namespace magfsi::fluid
