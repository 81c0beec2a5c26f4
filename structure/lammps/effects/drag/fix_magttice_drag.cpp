#include "structure/lammps/effects/drag/fix_magttice_drag.h"

#include "atom.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include <cmath>

#include "structure/lammps/failure.h"

namespace magfsi::structure {

FixMagtticeDrag::FixMagtticeDrag(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg != 4) {
        fail(*error,
             std::string("fix ") + id + " magttice/drag takes one argument, the rate");
    }
    rate_1_s_ = LAMMPS_NS::utils::numeric(FLERR, arg[3], false, lmp);
    if (!(rate_1_s_ >= 0)) {
        fail(*error, std::string("fix ") + id + " magttice/drag: the rate found is " +
                         arg[3] + ", it must not be negative");
    }
    dynamic_group_allow = 1;
}

int FixMagtticeDrag::setmask() {
    return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::FINAL_INTEGRATE;
}

void FixMagtticeDrag::reset_dt() {
    half_step_factor_ = std::exp(-0.5 * rate_1_s_ * update->dt);
}

// The velocity decays exactly, at any rate and step, half a step at a time. As a force it
// would need the velocity of the half step, which a restart from positions and velocities
// does not have: the motion would not go on as it was.
void FixMagtticeDrag::slow_down() {
    double* const* const v = atom->v;
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) == 0) continue;
        for (int d = 0; d < 3; ++d) v[i][d] *= half_step_factor_;
    }
}

}  // namespace magfsi::structure
