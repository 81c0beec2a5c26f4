#include "adapters/lammps/fix_fluid_force.h"

#include "atom.h"
#include "update.h"

namespace magfsi::lammps {

FixFluidForce::FixFluidForce(LAMMPS_NS::LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words) {}

int FixFluidForce::setmask() {
    return LAMMPS_NS::FixConst::PRE_REVERSE;
}

void FixFluidForce::pre_reverse(int, int) {
    if (nodal_force_ && atom->nlocal > 0)
        nodal_force_(atom->v[0], atom->f[0], update->dt);
}

LAMMPS_NS::Fix* FixFluidForce::create(LAMMPS_NS::LAMMPS* lammps, int count,
                                      char** words) {
    return new FixFluidForce(lammps, count, words);
}

}  // namespace magfsi::lammps
