// How deep points of a body lie below its surface.
#pragma once

#include <span>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// Distance of each point [m] from a part of the surface, undeformed, at most `limit_m`:
// what lies farther is not searched for. The surface is taken as points `spacing_m`
// apart, so that distances are too large by up to spacing_m^2 / (4 distance).
std::vector<double> depths(const Mesh& mesh, std::span<const SurfaceQuad> surface,
                           std::span<const MaterialPoint> points, double spacing_m,
                           double limit_m);

}  // namespace magfsi::structure
