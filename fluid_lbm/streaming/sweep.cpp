#include "fluid_lbm/streaming/sweep.h"

#include "fluid_lbm/boundary/x_ends.h"

namespace magfsi::fluid {

namespace {

template <class Real>
void sweep_rows(const PopulationRows<Real>& populations, const RowLayout& layout,
                Arrangement arrangement, const ForcedRows& forces,
                const RowKernels<Real>& kernels, const CollisionParameters& parameters) {
    const bool swapped = arrangement == Arrangement::swapped;
    const int rows = layout.ny * layout.nz;
#pragma omp parallel for schedule(static)
    for (int row = 0; row < rows; ++row) {
        const int y = row % layout.ny, z = row / layout.ny;
        const RowPointers<Real> p = pointers(populations, layout, arrangement, y, z);
        const ForcePointers force = forces.row(y, z);
        const auto kernel = force.at[0] != nullptr ? kernels.forced : kernels.plain;
        if (swapped) open_x_ends(p, layout);
        kernel(p.at, force.at, layout.nx, parameters);
        if (swapped) close_x_ends(p, layout);
    }
}

}  // namespace

void sweep(const Populations& populations, const RowLayout& layout,
           Arrangement arrangement, const ForcedRows& forces, const AnyKernels& kernels,
           const CollisionParameters& parameters) {
    std::visit(
        [&]<class Real>(const ChosenKernels<Real>& chosen) {
            sweep_rows(populations.rows<Real>(), layout, arrangement, forces, chosen.rows,
                       parameters);
        },
        kernels);
}

}  // namespace magfsi::fluid
