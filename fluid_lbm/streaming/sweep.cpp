#include "fluid_lbm/streaming/sweep.h"

#include "fluid_lbm/boundary/x_ends.h"

namespace magfsi::fluid {

void sweep(const Populations& populations, const RowLayout& layout,
           Arrangement arrangement, const ForcedRows& forces, const RowKernels& kernels,
           double omega) {
    const bool swapped = arrangement == Arrangement::swapped;
    const int rows = layout.ny * layout.nz;
    for (int row = 0; row < rows; ++row) {
        const int y = row % layout.ny, z = row / layout.ny;
        const RowPointers p = pointers(populations, layout, arrangement, y, z);
        const ForcePointers force = forces.row(y, z);
        const RowKernel kernel = force.at[0] != nullptr ? kernels.forced : kernels.plain;
        if (swapped) open_x_ends(p, layout);
        kernel(p.at, force.at, layout.nx, omega);
        if (swapped) close_x_ends(p, layout);
    }
}

}  // namespace magfsi::fluid
