#include "structure/lammps/register_styles.h"

namespace magfsi::structure {

void register_clamps(LAMMPS_NS::LAMMPS&) {}  // LAMMPS has what it takes

}  // namespace magfsi::structure
