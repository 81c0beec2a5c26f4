// Sides without shear: specular reflection half a cell outside the cells at the side. The
// population that enters a cell is the mirror image of the one that left a neighbour
// along the side. After the sweep both are bounced back, so that reflection is an
// exchange of two values between neighbours: mass and tangential momentum are kept to the
// bit.
#pragma once

#include <mpi.h>

#include <vector>

#include "fluid_lbm/boundary/lattice_side.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

class FreeSlip {
  public:
    // Of one side, on a rank that touches it. comm must outlive the object.
    FreeSlip(MPI_Comm comm, const Decomposition& decomposition, int rank, int side,
             const CellBox& side_cells);

    // After the exchange of populations. Collective among neighbours that touch the side.
    // At an edge with a wall, an inlet or another side with free slip the population that
    // comes out of the edge is left bounced back: reflection in the edge.
    void apply(const Populations& populations, const RowLayout& layout);

  private:
    // Reflection along one axis of the side's plane: population `up`, leaning to the high
    // end, with `down` of the cell below.
    struct Lean {
        int axis, up, down;
        bool wraps;               // periodic and not cut
        int low_rank, high_rank;  // beyond the ends, no_rank if none
    };

    template <class Real>
    void swap_inside(const PopulationRows<Real>& rows, const RowLayout& layout,
                     const Lean& lean) const;
    template <class Real>
    void swap_across(const PopulationRows<Real>& rows, const RowLayout& layout,
                     const Lean& lean);

    MPI_Comm comm_;
    CellBox cells_;
    std::vector<Lean> leans_;
    std::vector<double> sent_[2], received_[2];
};

}  // namespace magfsi::fluid
