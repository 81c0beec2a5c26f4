#include "modify.h"

#include "structure/lammps/effects/drag/fix_magttice_drag.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/style_creator.h"

namespace magfsi::structure {

void register_drag(LAMMPS_NS::LAMMPS& lammps) {
    (*lammps.modify->fix_map)["magttice/drag"] = &create<FixMagtticeDrag, LAMMPS_NS::Fix>;
}

}  // namespace magfsi::structure
