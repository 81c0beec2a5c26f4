#include "structure/lammps/register_styles.h"

namespace magfsi::structure {

void register_gravity(LAMMPS_NS::LAMMPS&) {}  // LAMMPS has it

}  // namespace magfsi::structure
