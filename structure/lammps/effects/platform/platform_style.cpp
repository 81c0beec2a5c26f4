#include "modify.h"

#include "structure/lammps/effects/platform/fix_magttice_platform.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/style_creator.h"

namespace magfsi::structure {

void register_platform(LAMMPS_NS::LAMMPS& lammps) {
    (*lammps.modify->fix_map)["magttice/platform"] =
        &create<FixMagtticePlatform, LAMMPS_NS::Fix>;
}

}  // namespace magfsi::structure
