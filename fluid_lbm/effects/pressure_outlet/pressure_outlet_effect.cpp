#include "fluid_lbm/boundary/refuse.h"
#include "fluid_lbm/boundary/side_effect.h"
#include "fluid_lbm/effects/pressure_outlet/pressure_outlet.h"

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

class Outlets final : public SideEffect {
  public:
    explicit Outlets(std::vector<PressureOutlet> outlets)
        : outlets_(std::move(outlets)) {}
    void before_sweep(const Populations& populations, Arrangement arrangement) override {
        for (PressureOutlet& outlet : outlets_) outlet.look(populations, arrangement);
    }
    void end_step(const Populations& populations, Arrangement arrangement) override {
        for (const PressureOutlet& outlet : outlets_)
            outlet.apply(populations, arrangement);
    }

  private:
    std::vector<PressureOutlet> outlets_;
};

}  // namespace

std::unique_ptr<SideEffect> make_pressure_outlet_effect(const SideContext& in) {
    std::vector<PressureOutlet> outlets;
    for (int side = 0; side < 6; ++side) {
        if (in.sides[side].kind != BoundaryKind::pressure_outlet) continue;
        check_depth(in.decomposition, side);
        const auto cells = cells_at_side(in.owned(), in.decomposition.cells, side);
        if (!cells || in.periodic(side)) continue;
        outlets.emplace_back(in.sides[side], side,
                             open_cells(in.sides[side], *cells, in.owned(), in.solids),
                             in.decomposition.cells[axis_of(side)], in.populations,
                             in.layout);
    }
    if (outlets.empty()) return nullptr;
    return std::make_unique<Outlets>(std::move(outlets));
}

}  // namespace magfsi::fluid
