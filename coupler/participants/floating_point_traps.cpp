#include "coupler/participants/floating_point_traps.h"

#include <cfenv>

namespace magfsi::coupler {

void trap_floating_point_faults() {
#ifdef MAGFSI_TRAPS
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
}

}  // namespace magfsi::coupler
