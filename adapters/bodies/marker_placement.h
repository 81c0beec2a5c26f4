// Where the Lagrangian markers of a body sit. They follow the fluid's grid in their
// spacing and the body's elements in their motion.
#pragma once

#include <vector>

#include "coupler/scene/scene.h"
#include "structure/mesh/mesh.h"

namespace magfsi::bodies {

// A marker before it is known which rank owns its element.
struct PlacedMarker {
    structure::MaterialPoint point;
    double volume_m3 = 0;
    int body = 0;
};

// Markers on the sheet spanned by the body's two longer edges: on its mid-surface, or
// half of the volume on each of its two faces. A marker stands for its area times one
// grid spacing: the thickness of fluid that the smeared kernel moves with it.
// number: of the body. Throws std::invalid_argument on a body that is
// neither a block nor a sheet.
std::vector<PlacedMarker> place_markers(const scene::Body& body,
                                        const scene::ImmersedBoundary& boundary,
                                        double grid_spacing_m, int number);

}  // namespace magfsi::bodies
