#include "coupler/immersed_boundary/fluid_side.h"

#include <utility>

namespace magfsi::coupler {

FluidSide::FluidSide(GridFluid& fluid, const CellBox& owned, Kernel kernel,
                     double coupled_step_s)
    : fluid_(fluid),
      coupled_step_s_(coupled_step_s),
      spread_rows_(fluid.grid(), owned, kernel),
      sample_rows_(fluid.grid(), owned, kernel) {}

void FluidSide::spread(std::span<const Vec3> points_m, std::span<const Vec3> impulse) {
    // Impulses act where the velocities were sampled last, as a rule; in a step that is
    // repeated, where they acted before.
    if (!spread_rows_.placed_at(points_m)) {
        if (sample_rows_.placed_at(points_m))
            std::swap(spread_rows_, sample_rows_);
        else
            spread_rows_.place(points_m);
    }
    density_.assign(3 * spread_rows_.cells(), 0.0);
    spread_more(impulse);
}

void FluidSide::spread_more(std::span<const Vec3> impulse) {
    force_.resize(impulse.size());
    for (std::size_t m = 0; m < impulse.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d)
            force_[m][d] = impulse[m][d] / coupled_step_s_;
    }
    spread_rows_.spread(force_, density_);
    fluid_.set_force(spread_rows_.rows(), density_);
}

std::span<const Vec3> FluidSide::sample(std::span<const Vec3> points_m) {
    read_cells(points_m);
    return to_markers(points_m.size());
}

std::span<const Vec3> FluidSide::sample_forced(std::span<const Vec3> points_m,
                                               double density_kg_m3) {
    read_cells(points_m);
    sample_rows_.add_shared(spread_rows_, density_, coupled_step_s_ / (2 * density_kg_m3),
                            velocity_);
    return to_markers(points_m.size());
}

void FluidSide::read_cells(std::span<const Vec3> points_m) {
    sample_rows_.place(points_m);
    velocity_.resize(3 * sample_rows_.cells());
    fluid_.velocity(sample_rows_.rows(), velocity_);
}

std::span<const Vec3> FluidSide::to_markers(std::size_t markers) {
    sampled_.resize(markers);
    sample_rows_.interpolate(velocity_, sampled_);
    return sampled_;
}

InterfaceBalance FluidSide::received() {
    std::vector<double> velocity(3 * spread_rows_.cells());
    fluid_.velocity(spread_rows_.rows(), velocity);
    return received(velocity);
}

InterfaceBalance FluidSide::received(std::span<const double> velocity) const {
    const double h = fluid_.grid().spacing_m;
    const double impulse_of_density = h * h * h * coupled_step_s_;
    InterfaceBalance b;
    for (std::size_t i = 0; i < density_.size(); ++i) {
        const double impulse = density_[i] * impulse_of_density;
        b.impulse_n_s[i % 3] += impulse;
        b.work_j += impulse * velocity[i];
    }
    return b;
}

}  // namespace magfsi::coupler
