#include "fluid_lbm/streaming/sweep.h"

#include "fluid_lbm/boundary/x_ends.h"
#include "fluid_lbm/streaming/row_walk.h"

namespace magfsi::fluid {

namespace {

void keep_first(std::optional<UnsoundCell>& kept, const UnsoundCell& found) {
    if (!kept || found.before(*kept)) kept = found;
}

struct NoForces {};

template <class Real>
ForcePointers<Real> force_of(NoForces, int, int) {
    return {};
}

template <class Real>
ForcePointers<Real> force_of(const ForcedRows& forces, int y, int z) {
    return forces.row<Real>(y, z);
}

// Forces: ForcedRows or NoForces.
template <class Forces, class Real>
std::optional<UnsoundCell> step_row(const SweepInput& in,
                                    const ChosenKernels<Real>& kernels,
                                    const RowWalk<Real>& walk, const Forces& forces,
                                    int y, int z) {
    const bool swapped = in.arrangement == Arrangement::swapped;
    const RowPointers<Real> p = walk.at(y, z);
    const auto force = force_of<Real>(forces, y, z);
    const auto kernel = force.at[0] != nullptr ? kernels.rows.forced : kernels.rows.plain;
    if (swapped) {
        prefetch_x_ends(p, in.layout, in.populations.row_stride());
        open_x_ends(p, in.layout);
    }
    const bool sound = kernel(p.at, force.at, in.layout.nx, in.parameters);
    std::optional<UnsoundCell> unsound;
    if (!sound) unsound = find_unsound(p, force, in.layout.nx, kernels.moments, y, z);
    if (swapped) close_x_ends(p, in.layout);
    return unsound;
}

template <class Forces, class Real>
std::optional<UnsoundCell> sweep_rows(const SweepInput& in,
                                      const ChosenKernels<Real>& kernels,
                                      const Forces& forces, const RowBox& box) {
    const int count = box.size(), length = box.y_end - box.y_begin;
    const PopulationRows<Real> rows = in.populations.rows<Real>();
    const RowWalk<Real> walk(rows, in.layout, in.arrangement,
                             in.populations.row_stride());
    std::optional<UnsoundCell> first;
#pragma omp parallel
    {
        std::optional<UnsoundCell> mine;
#pragma omp for schedule(static)
        for (int i = 0; i < count; ++i) {
            const auto found =
                step_row(in, kernels, walk, forces, box.y_begin + i % length,
                         box.z_begin + i / length);
            if (found) keep_first(mine, *found);
        }
#pragma omp critical
        if (mine) keep_first(first, *mine);
    }
    return first;
}

}  // namespace

std::optional<UnsoundCell> sweep(const SweepInput& in, const RowBox& box) {
    return std::visit(
        [&](const auto& kernels) {
            return in.forces ? sweep_rows(in, kernels, *in.forces, box)
                             : sweep_rows(in, kernels, NoForces{}, box);
        },
        in.kernels);
}

}  // namespace magfsi::fluid
