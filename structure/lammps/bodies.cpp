#include "structure/lammps/bodies.h"

#include "modify.h"

#include <cstring>

#include "structure/lammps/fix_magttice.h"

namespace magfsi::structure {

std::vector<FixMagttice*> bodies_of(const LAMMPS_NS::Modify& modify) {
    std::vector<FixMagttice*> out;
    for (int i = 0; i < modify.nfix; ++i) {
        if (std::strcmp(modify.fix[i]->style, "magttice") != 0) continue;
        out.push_back(static_cast<FixMagttice*>(modify.fix[i]));
    }
    return out;
}

}  // namespace magfsi::structure
