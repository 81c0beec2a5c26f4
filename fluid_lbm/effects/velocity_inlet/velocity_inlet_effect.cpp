#include "fluid_lbm/boundary/side_effect.h"
#include "fluid_lbm/effects/velocity_inlet/velocity_inlet.h"

namespace magfsi::fluid {

namespace {

class Inlets final : public SideEffect {
  public:
    explicit Inlets(std::vector<VelocityInlet> inlets) : inlets_(std::move(inlets)) {}
    void enter(const Populations& populations, const RowLayout& layout,
               double time) override {
        for (VelocityInlet& inlet : inlets_) inlet.apply(populations, layout, time);
    }

  private:
    std::vector<VelocityInlet> inlets_;
};

}  // namespace

std::unique_ptr<SideEffect> make_velocity_inlet_effect(const SideContext& in) {
    std::vector<VelocityInlet> inlets;
    for (int side = 0; side < 6; ++side) {
        if (!in.is(side, BoundaryKind::velocity_inlet)) continue;
        const auto cells = cells_at_side(in.owned(), in.decomposition.cells, side);
        if (cells)
            inlets.emplace_back(in.sides[side], side, *cells, in.owned(),
                                in.decomposition.cells, in.decomposition.periodic);
    }
    if (inlets.empty()) return nullptr;
    return std::make_unique<Inlets>(std::move(inlets));
}

}  // namespace magfsi::fluid
