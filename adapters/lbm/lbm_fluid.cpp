#include "adapters/lbm/lbm_fluid.h"

namespace magfsi::lbm {

LbmFluid::LbmFluid(fluid::Fluid& fluid) : fluid_(fluid) {
    const fluid::FluidConfig& config = fluid.config();
    grid_.spacing_m = config.spacing_m;
    grid_.cells = config.cells;
    for (std::size_t d = 0; d < 3; ++d) {
        grid_.periodic[d] =
            config.boundaries[2 * d].kind == fluid::BoundaryKind::periodic;
    }
    for (const fluid::CellBox& box : fluid.owned_by_rank()) {
        grid_.owned_by_rank.push_back({box.lo, box.hi});
    }
    for (const fluid::CellRow& r : fluid.solid_rows())
        grid_.solid.push_back({r.y, r.z, r.x_begin, r.x_end});
}

std::span<const fluid::CellRow> LbmFluid::convert(
    std::span<const coupler::GridRow> rows) {
    rows_.clear();
    for (const coupler::GridRow& r : rows)
        rows_.push_back({r.y, r.z, r.x_begin, r.x_end});
    return rows_;
}

void LbmFluid::velocity(std::span<const coupler::GridRow> rows, std::span<double> out) {
    fluid_.velocity(convert(rows), out);
}

void LbmFluid::set_force(std::span<const coupler::GridRow> rows,
                         std::span<const double> density) {
    fluid_.set_force(convert(rows), density);
}

void LbmFluid::advance() {
    fluid_.step();
}

}  // namespace magfsi::lbm
