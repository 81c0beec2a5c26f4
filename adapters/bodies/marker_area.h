// The piece of a body's surface that a marker stands for: where leakage is measured.
#pragma once

#include <span>

#include "adapters/bodies/marker_placement.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

// The marker stands for this vector area [m2], outward, of the undeformed body.
void set_area(PlacedMarker& marker, const structure::Mesh& mesh,
              const structure::Vec3& area_m2);

// Each quad of the surface goes to the marker nearest to its middle: the areas of the
// markers add up to that of the surface.
void share_surface(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                   std::span<const structure::SurfaceQuad> surface, double spacing_m);

}  // namespace magfsi::bodies
