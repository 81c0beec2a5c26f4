// The one table of all keys. A new key is one line here and one line in bind.h.
#pragma once

#include "adapters/scene/field.h"

namespace magfsi::scene {

// The whole scene as a group without a name.
const Field& scene_fields();

// Its parts, a source file each.
Field bodies_fields();
Field magnetic_field_fields();
Field fluid_fields();
Field coupling_fields();
Field probes_fields();
Field output_fields();

}  // namespace magfsi::scene
