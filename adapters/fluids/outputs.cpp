#include "adapters/fluids/fluid_run.h"

namespace magfsi::fluids {

#define MAGFSI_EFFECT(name) extern const FluidOutput name##_output;
#include "adapters/fluids/effects.inc"
#undef MAGFSI_EFFECT

const FluidOutput* fluid_outputs() {
#define MAGFSI_EFFECT(name) name##_output,
    static const FluidOutput registered[] = {
#include "adapters/fluids/effects.inc"
        {}};
#undef MAGFSI_EFFECT
    return registered;
}

}  // namespace magfsi::fluids
