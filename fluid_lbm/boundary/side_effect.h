// What an effect of effects.inc does at the sides of this rank's box. It gives a function
// make_NAME_effect of the type MakeSideEffect.
#pragma once

#include <mpi.h>

#include <array>
#include <memory>

#include "fluid_lbm/boundary/lattice_side.h"
#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/obstacle/solid_map.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

// See boundaries.h for when each is called.
class SideEffect {
  public:
    virtual ~SideEffect() = default;
    virtual void before_sweep(const Populations&, Arrangement) {}
    virtual void enter(const Populations&, const RowLayout&, double /*time*/) {}
    virtual void end_step(const Populations&, Arrangement) {}
};

// All outlive the effects that are made from it.
struct SideContext {
    MPI_Comm comm;
    const Decomposition& decomposition;
    int rank;
    const std::array<LatticeSide, 6>& sides;
    const std::array<Vec3, 6>& wall_velocity;
    const Populations& populations;
    const RowLayout& layout;
    const SolidMap* solids;  // null without obstacles

    // Whether the axis of a side is periodic: its kind then says nothing.
    bool periodic(int side) const { return decomposition.periodic[axis_of(side)]; }
    bool is(int side, BoundaryKind kind) const {
        return !periodic(side) && sides[side].kind == kind;
    }
    const CellBox& owned() const { return decomposition.boxes[rank]; }
};

// Null where the scene does not ask for it, or not on this rank. Throws
// std::invalid_argument, on all ranks alike.
using MakeSideEffect = std::unique_ptr<SideEffect> (*)(const SideContext&);

}  // namespace magfsi::fluid
