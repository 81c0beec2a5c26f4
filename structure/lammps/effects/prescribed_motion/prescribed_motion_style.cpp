#include "modify.h"

#include "structure/lammps/effects/prescribed_motion/fix_magttice_motion.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/style_creator.h"

namespace magfsi::structure {

void register_prescribed_motion(LAMMPS_NS::LAMMPS& lammps) {
    (*lammps.modify->fix_map)["magttice/motion"] =
        &create<FixMagtticeMotion, LAMMPS_NS::Fix>;
}

}  // namespace magfsi::structure
