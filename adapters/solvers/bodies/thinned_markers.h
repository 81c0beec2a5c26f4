// SPDX-License-Identifier: GPL-2.0-or-later
// Markers picked from dense points, about a grid spacing apart, in a mesh of any shape.
#pragma once

#include <span>
#include <vector>

#include "adapters/solvers/bodies/marker_placement.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

// Sets the volume of each marker to that of the points that are nearest to it.
void share_volume(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                  std::span<const PlacedMarker> points, double apart_m);

// Moves the points within depth_m of the surface to the front, each the nearest to the
// one before, so that `thinned` makes an even row of them.
void begin_along(std::vector<PlacedMarker>& points, const structure::Mesh& mesh,
                 std::span<const structure::SurfaceQuad> surface, double depth_m,
                 double fine_m);

// Picks in turn the points that are at least apart_m from all picked before in the same
// layer; each gets the volume of the layer's points that are nearest to it. A point is
// picked together with its images under those mirrors and quarter turns of the axes that
// leave all points as they are, so that the markers have every such symmetry of the body.
// layers: dense points, fine_m apart; none is empty. Points nearer than that to a mirror
// are moved onto it.
std::vector<PlacedMarker> thinned(std::span<const std::vector<PlacedMarker>> layers,
                                  const structure::Mesh& mesh, double apart_m,
                                  double fine_m);

// The same of a shell and then of the points inside, each without the wide gaps that
// symmetries may leave where a row closes; the shell's are moved to even distances.
std::vector<PlacedMarker> thinned_shell(const std::vector<PlacedMarker>& shell,
                                        const std::vector<PlacedMarker>& inside,
                                        const structure::Mesh& mesh, double apart_m,
                                        double fine_m);

}  // namespace magfsi::bodies
