#include "fluid_lbm/boundary/side_effect.h"
#include "fluid_lbm/effects/free_slip/free_slip.h"

namespace magfsi::fluid {

namespace {

class FreeSlipSides final : public SideEffect {
  public:
    explicit FreeSlipSides(std::vector<FreeSlip> sides) : sides_(std::move(sides)) {}
    void enter(const Populations& populations, const RowLayout& layout, double) override {
        for (FreeSlip& side : sides_) side.apply(populations, layout);
    }

  private:
    std::vector<FreeSlip> sides_;
};

}  // namespace

std::unique_ptr<SideEffect> make_free_slip_effect(const SideContext& in) {
    std::vector<FreeSlip> sides;
    for (int side = 0; side < 6; ++side) {
        if (!in.is(side, BoundaryKind::free_slip)) continue;
        const auto cells = cells_at_side(in.owned(), in.decomposition.cells, side);
        if (cells) sides.emplace_back(in.comm, in.decomposition, in.rank, side, *cells);
    }
    if (sides.empty()) return nullptr;
    return std::make_unique<FreeSlipSides>(std::move(sides));
}

}  // namespace magfsi::fluid
