// How our styles end a run that cannot go on.
#pragma once

#include <string>

namespace LAMMPS_NS {
class Error;
}

namespace magfsi::structure {

// Hands the cause to the handler of register_styles.h, or to LAMMPS's error->one. One
// rank is enough.
[[noreturn]] void fail(LAMMPS_NS::Error& error, const std::string& cause);

}  // namespace magfsi::structure
