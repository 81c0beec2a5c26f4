// Stiffness of one element in its undeformed state, the linear limit of its energy.
#pragma once

#include "structure/lattice/element_energy.h"

namespace magfsi::structure {

// K_e = G L + (K + G) / V0 dV dV^T - G d2V + hourglass_tangent, all at J = 1 [N/m].
Matrix24 stiffness_at_rest(const ElementReference& reference, const Material& material,
                           const Positions8& nodes_m);

}  // namespace magfsi::structure
