// SPDX-License-Identifier: GPL-2.0-or-later
// Points spread over the surface and through the volume of a body, carried by its
// elements: markers of an immersed boundary, samples of a contact surface.
#pragma once

#include <span>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

struct SurfacePoint {
    MaterialPoint point;
    double area_m2 = 0;  // the part of the surface that it stands for, undeformed
    Vec3 normal{};       // outward unit vector, undeformed
};

// A point in the middle of each cell of each quad: quads smaller than the spacing carry
// one. Give all of boundary_quads(mesh), or one side of a sheet.
std::vector<SurfacePoint> surface_points(const Mesh& mesh,
                                         std::span<const SurfaceQuad> surface,
                                         double spacing_m);

struct VolumePoint {
    MaterialPoint point;
    double volume_m3 = 0;  // the part of the body that it stands for, undeformed
};

// Cuts each element along its local axes into parts of at most `spacing_m` and puts a
// point into the middle of each. The volumes of an element's points add up to its own, by
// the midpoint rule, scaled. Throws std::invalid_argument for a spacing that is not
// positive.
std::vector<VolumePoint> volume_points(const Mesh& mesh, double spacing_m);

// Sum of the elements' volumes, undeformed [m3].
double volume_m3(const Mesh& mesh);

// Distance of each point [m] from a part of the surface, undeformed, at most `limit_m`:
// what lies farther is not searched for. The surface is taken as points `spacing_m`
// apart, so that distances are too large by up to spacing_m^2 / (4 distance).
std::vector<double> depths(const Mesh& mesh, std::span<const SurfaceQuad> surface,
                           std::span<const MaterialPoint> points, double spacing_m,
                           double limit_m);

}  // namespace magfsi::structure
