#include "structure/lammps/fix_magttice_drag.h"

#include "atom.h"
#include "error.h"
#include "utils.h"

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
    return LAMMPS_NS::FixConst::POST_FORCE;
}

void FixMagtticeDrag::post_force(int) {
    double* const* const v = atom->v;
    double* const* const f = atom->f;
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) == 0) continue;
        const double mass =
            atom->rmass != nullptr ? atom->rmass[i] : atom->mass[atom->type[i]];
        for (int d = 0; d < 3; ++d) f[i][d] -= rate_1_s_ * mass * v[i][d];
    }
}

}  // namespace magfsi::structure
