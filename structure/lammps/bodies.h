// The bodies of a LAMMPS run: its fixes of style magttice.
#pragma once

#include <vector>

namespace LAMMPS_NS {
class Modify;
}

namespace magfsi::structure {

class FixMagttice;

// In the order of the script.
std::vector<FixMagttice*> bodies_of(const LAMMPS_NS::Modify& modify);

}  // namespace magfsi::structure
