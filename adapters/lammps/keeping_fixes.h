// Fixes of LAMMPS that keep something with their atoms, over restarts too.
#pragma once

#include <vector>

#include "fix.h"
#include "modify.h"

namespace magfsi::lammps {

inline std::vector<LAMMPS_NS::Fix*> keeping_fixes(const LAMMPS_NS::Modify& modify) {
    std::vector<LAMMPS_NS::Fix*> found;
    for (int i = 0; i < modify.nfix; ++i) {
        if (modify.fix[i]->restart_peratom != 0) found.push_back(modify.fix[i]);
    }
    return found;
}

// Numbers an atom. LAMMPS counts the length of the record in.
inline std::size_t kept_values(LAMMPS_NS::Fix& fix) {
    return static_cast<std::size_t>(fix.maxsize_restart() - 1);
}

}  // namespace magfsi::lammps
