// fluid_lbm/ as a fluid that the coupler can drive.
#pragma once

#include <vector>

#include "coupler/immersed_boundary/grid_fluid.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

class LbmFluid final : public coupler::GridFluid {
  public:
    explicit LbmFluid(fluid::Fluid& fluid);

    const coupler::Grid& grid() const override { return grid_; }
    void velocity(std::span<const coupler::GridRow> rows, std::span<double> out) override;
    void set_force(std::span<const coupler::GridRow> rows,
                   std::span<const double> density) override;
    void advance() override;

  private:
    std::span<const fluid::CellRow> convert(std::span<const coupler::GridRow> rows);

    fluid::Fluid& fluid_;
    coupler::Grid grid_;
    std::vector<fluid::CellRow> rows_;
};

}  // namespace magfsi::lbm
