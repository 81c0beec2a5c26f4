// How LAMMPS makes an object of one of our styles.
#pragma once

#include "lammps.h"

namespace magfsi::structure {

template <class Style, class Base>
Base* create(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
    return new Style(lammps, narg, arg);
}

}  // namespace magfsi::structure
