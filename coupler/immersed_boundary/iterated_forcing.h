// Iterated (multi-direct) forcing (Luo et al. 2007; Wang, Fan, Luo 2008): once the
// impulses of a coupled step are spread, the fluid at a marker still slips, for what
// neighbours give overlaps and what a thin body gives is smeared. Each iteration takes
// the slip that is left and gives the fluid the impulse that would remove it, or the part
// that a strength below 1 asks for,
//   min(strength, 1) 2 rho dV (W - U'),
// W the marker's mean velocity over the step, U' the fluid's with half of the step's
// forces so far, F dt / (2 rho): the physical velocity of Guo's scheme.
//
// The structure has moved on by then: it feels what these impulses took over its next
// step, as a constant force. A force that is held is stable only where the drag of eq.
// (13), evaluated in every substep, exceeds it (whole impulses after a weak drag fed the
// sheet: 2 iterations at strength 0.25, 3 at 0.5); with three and four at strength 1
// sheets begin to oscillate, five diverge.
#pragma once

#include <span>
#include <vector>

#include "coupler/immersed_boundary/penalty_force.h"

namespace magfsi::coupler {

class IteratedForcing {
  public:
    IteratedForcing(std::span<const Marker> markers, const PenaltyScale& scale);

    void begin_step();  // forgets the impulses of the step before

    // One iteration: the impulses [N s] that remove the slip which is left. Positions at
    // the ends of the step [m]; fluid_velocity: U' at `before_m` [m/s].
    std::span<const Vec3> correct(std::span<const Vec3> before_m,
                                  std::span<const Vec3> now_m,
                                  std::span<const Vec3> fluid_velocity);

    // Of all iterations since begin_step, what each marker gave besides the drag [N s].
    std::span<Vec3> impulse() { return impulse_; }
    std::span<const Vec3> impulse() const { return impulse_; }
    // What each marker gave in all, with that of the drag [N s].
    std::vector<Vec3> added_to(std::span<const Vec3> of_drag) const;

  private:
    double coupled_step_s_;
    std::vector<double> moved_mass_kg_;  // min(strength, 1) 2 rho dV
    std::vector<Vec3> last_, impulse_;
};

}  // namespace magfsi::coupler
