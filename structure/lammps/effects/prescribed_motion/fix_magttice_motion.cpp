#include "structure/lammps/effects/prescribed_motion/fix_magttice_motion.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "structure/lammps/failure.h"

namespace magfsi::structure {

FixMagtticeMotion::FixMagtticeMotion(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    try {
        course_ = motion_from({arg + 3, arg + narg});
    } catch (const std::invalid_argument& fault) {
        fail(*error, std::string("fix ") + id + " magttice/motion: " + fault.what());
    }
    dynamic_group_allow = 1;
}

int FixMagtticeMotion::setmask() {
    return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::FINAL_INTEGRATE;
}

// From the number of the step, so that it stays right over restarts.
double FixMagtticeMotion::time_s(int steps_ago) const {
    return static_cast<double>(update->ntimestep - steps_ago) * update->dt;
}

// Before the first forces are evaluated, and before ghosts get their velocities.
void FixMagtticeMotion::init() {
    set_velocity(velocity_m_s(course_, time_s(0)));
}

// Between the two, forces see the mean velocity of the step, as velocity Verlet's half
// step has it for all other atoms.
void FixMagtticeMotion::initial_integrate(int) {
    const Vec3 from = displacement_m(course_, time_s(1));
    const Vec3 to = displacement_m(course_, time_s(0));
    Vec3 gain{}, mean{};
    for (std::size_t d = 0; d < 3; ++d) {
        gain[d] = to[d] - from[d];
        mean[d] = gain[d] / update->dt;
    }
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) == 0) continue;
        for (std::size_t d = 0; d < 3; ++d) atom->x[i][d] += gain[d];
    }
    set_velocity(mean);
}

void FixMagtticeMotion::final_integrate() {
    set_velocity(velocity_m_s(course_, time_s(0)));
}

void FixMagtticeMotion::set_velocity(const Vec3& velocity_m_s) {
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) != 0)
            std::copy_n(velocity_m_s.data(), 3, atom->v[i]);
    }
}

}  // namespace magfsi::structure
