// The fluid that fills the body's own volume on the fluid's grid, as far as the body's
// nodes do not lack its mass already. It is fictitious: its inertia is taken away again,
// with the sampled velocity U for its motion, and its weight is the buoyancy (Uhlmann
// 2005; Kempe, Froehlich 2012):
//   F = rho_f dV (A - g),  A following dU/dt over about ten coupled steps.
//
// Light bodies stay stable: body and fluid are tied by the immersed boundary within the
// step, so an error of A accelerates the body's mass, the fluid inside and the added mass
// together, and comes back smaller by rho_f / (rho_s + rho_f (1 + C_added)). But the
// fluid's pressure, which is what C_added stands for, needs some steps to travel through
// the body; followed at once, A diverged below a density ratio of 0.4, at a fifth of the
// rate below 0.05. At a tenth a sheet of 0.01 times the fluid's density runs. All this is
// so for U from before the step; in a step that is repeated until U is that of its own
// end, A may follow at once.
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/markers.h"

namespace magfsi::coupler {

struct EnclosedFluidScale {
    double fluid_density_kg_m3 = 0;
    double coupled_step_s = 0;
    Vec3 gravity_m_s2{};
    double follow = 0.1;  // part of the change of dU/dt that A takes on in a coupled step
};

class EnclosedFluid {
  public:
    EnclosedFluid(std::span<const Marker> markers, const EnclosedFluidScale& scale);

    // The fluid's velocity at every marker before the first coupled step [m/s], in which
    // it is taken to move steadily; then for each coming step.
    void start(std::span<const Vec3> fluid_velocity);
    void begin_step(std::span<const Vec3> fluid_velocity);

    // On every marker, constant over the coupled step [N].
    std::span<const Vec3> force() const { return force_; }

    // What the next step needs of those before: for checkpoints.
    std::span<Vec3> last_velocity() { return last_velocity_; }
    std::span<Vec3> acceleration() { return acceleration_; }

  private:
    template <bool Weighs>  // in gravity
    void follow(std::span<const Vec3> fluid_velocity);

    EnclosedFluidScale scale_;
    std::vector<double> mass_kg_;
    std::vector<Vec3> last_velocity_;
    std::vector<Vec3> acceleration_;
    std::vector<Vec3> force_;
};

}  // namespace magfsi::coupler
