#include "fluid_lbm/boundary/boundaries.h"

#include "fluid_lbm/boundary/refuse.h"

namespace magfsi::fluid {

namespace {

// An outlet reads the cell inside of each of its own.
void check_depth(const Decomposition& decomposition, int side) {
    const int axis = axis_of(side);
    for (const CellBox& box : decomposition.boxes) {
        if (box.hi[axis] - box.lo[axis] > 1) continue;
        refuse("fluid box is cut into parts of one cell along ", axis_name[axis],
               ", and the pressure outlet at ", side_name[side],
               " needs two; choose fewer fluid ranks");
    }
}

std::vector<Cell> open_cells(const LatticeSide& side, const CellBox& side_cells,
                             const CellBox& owned, const SolidMap* solids) {
    std::vector<Cell> cells;
    for_each_cell(side_cells, [&](const Cell& cell) {
        const Cell global{cell[0] + owned.lo[0], cell[1] + owned.lo[1],
                          cell[2] + owned.lo[2]};
        const bool open = !side.open || side.open(global);
        if (open && !(solids && solids->solid(cell))) cells.push_back(cell);
    });
    return cells;
}

}  // namespace

Boundaries::Boundaries(MPI_Comm comm, const Decomposition& decomposition, int rank,
                       const std::array<LatticeSide, 6>& sides,
                       const std::array<std::array<double, 3>, 6>& wall_velocity,
                       const Populations& populations, const RowLayout& layout,
                       const SolidMap* solids) {
    const CellBox& owned = decomposition.boxes[rank];
    for (int side = 0; side < 6; ++side) {
        if (sides[side].kind == BoundaryKind::pressure_outlet) {
            check_depth(decomposition, side);
        }
        const auto cells = cells_at_side(owned, decomposition.cells, side);
        if (!cells || decomposition.periodic[axis_of(side)]) continue;
        const LatticeSide& lattice = sides[side];
        if (lattice.kind == BoundaryKind::free_slip) {
            slips_.emplace_back(comm, decomposition, rank, side, *cells);
        } else if (lattice.kind == BoundaryKind::velocity_inlet) {
            inlets_.emplace_back(lattice, side, *cells, owned, decomposition.cells,
                                 decomposition.periodic);
        } else if (lattice.kind == BoundaryKind::pressure_outlet) {
            outlets_.emplace_back(
                lattice, side, open_cells(lattice, *cells, owned, solids),
                decomposition.cells[axis_of(side)], populations, layout);
        } else if (wall_velocity[side] != std::array<double, 3>{}) {
            moving_walls_.push_back({axis_of(side), side % 2, wall_velocity[side]});
        }
    }
}

void Boundaries::look_at_outlets(const Populations& populations,
                                 Arrangement arrangement) {
    for (PressureOutlet& outlet : outlets_) outlet.look(populations, arrangement);
}

void Boundaries::enter(const Populations& populations, const RowLayout& layout,
                       double time) {
    for (FreeSlip& slip : slips_) slip.apply(populations, layout);
    move_walls(populations, layout, moving_walls_);
    for (VelocityInlet& inlet : inlets_) inlet.apply(populations, layout, time);
}

void Boundaries::rebuild_outlets(const Populations& populations,
                                 Arrangement arrangement) const {
    for (const PressureOutlet& outlet : outlets_) outlet.apply(populations, arrangement);
}

}  // namespace magfsi::fluid
