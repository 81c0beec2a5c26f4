// SPDX-License-Identifier: GPL-2.0-or-later
// Points spread over the surface and through the volume of a body and carried by its
// elements: markers of an immersed boundary, samples of a contact surface.
#pragma once

#include <span>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// Point of the surface.
struct SurfacePoint {
    MaterialPoint point;
    double area_m2 = 0;  // share of the undeformed surface
    Vec3 normal{};       // outward unit vector of the undeformed surface
};

// Points in the middles of cells of at most spacing_m into which each quad is cut;
// smaller quads have one. surface: all of boundary_quads(mesh), or one side of a sheet.
std::vector<SurfacePoint> surface_points(const Mesh& mesh,
                                         std::span<const SurfaceQuad> surface,
                                         double spacing_m);

// Point of the volume.
struct VolumePoint {
    MaterialPoint point;
    double volume_m3 = 0;  // share of the undeformed volume
};

// Points in the middles of the parts of at most `spacing_m` into which each element is
// cut along its local axes. The volumes of an element's points, by the midpoint rule, are
// scaled to add up to its own. Throws std::invalid_argument on a spacing that is not
// positive.
std::vector<VolumePoint> volume_points(const Mesh& mesh, double spacing_m);

// Volume of the undeformed mesh [m3].
double volume_m3(const Mesh& mesh);

// Distance [m] of each point from a part of the undeformed surface, but at most
// `limit_m`, beyond which there is no search. The surface is taken as points spacing_m
// apart, so that distances are too large by up to spacing_m^2 / (4 distance).
std::vector<double> depths(const Mesh& mesh, std::span<const SurfaceQuad> surface,
                           std::span<const MaterialPoint> points, double spacing_m,
                           double limit_m);

}  // namespace magfsi::structure
