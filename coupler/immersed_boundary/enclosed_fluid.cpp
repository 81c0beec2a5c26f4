#include "coupler/immersed_boundary/enclosed_fluid.h"

namespace magfsi::coupler {

EnclosedFluid::EnclosedFluid(std::span<const Marker> markers,
                             const EnclosedFluidScale& scale)
    : scale_(scale),
      last_velocity_(markers.size()),
      acceleration_(markers.size()),
      force_(markers.size()) {
    mass_kg_.reserve(markers.size());
    for (const Marker& m : markers)
        mass_kg_.push_back(scale.fluid_density_kg_m3 * m.displaced_m3);
}

void EnclosedFluid::start(std::span<const Vec3> fluid_velocity) {
    last_velocity_.assign(fluid_velocity.begin(), fluid_velocity.end());
}

void EnclosedFluid::begin_step(std::span<const Vec3> fluid_velocity) {
    if (scale_.gravity_m_s2 != Vec3{})
        follow<true>(fluid_velocity);
    else
        follow<false>(fluid_velocity);
}

template <bool Weighs>
void EnclosedFluid::follow(std::span<const Vec3> fluid_velocity) {
    const double a_second = 1 / scale_.coupled_step_s;
    for (std::size_t m = 0; m < force_.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double now = (fluid_velocity[m][d] - last_velocity_[m][d]) * a_second;
            double& smooth = acceleration_[m][d];
            smooth += scale_.follow * (now - smooth);
            double relative = smooth;
            if constexpr (Weighs) relative -= scale_.gravity_m_s2[d];
            force_[m][d] = mass_kg_[m] * relative;
            last_velocity_[m][d] = fluid_velocity[m][d];
        }
    }
}

}  // namespace magfsi::coupler
