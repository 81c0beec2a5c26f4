// Points spread over surfaces of a body, carried by its elements: markers of an immersed
// boundary, samples of a contact surface.
#pragma once

#include <array>
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

// A cell of a quadrilateral: its middle (u, v) in [0, 1]^2, its area and unit normal.
struct QuadCell {
    double u = 0, v = 0;
    double area_m2 = 0;
    Vec3 normal{};
};

// Cuts a quadrilateral (corners in cyclic order, (u, v) = (0, 0) first, (1, 0) second)
// into cells of at most `spacing_m` along its edges; areas sum to quad_area. Throws
// std::invalid_argument for a spacing that is not positive.
std::vector<QuadCell> cut_quad(const std::array<Vec3, 4>& corners_m, double spacing_m);

// A point in the middle of each cell of each quad: quads smaller than the spacing carry
// one. Give all of boundary_quads(mesh), or one side of a sheet.
std::vector<SurfacePoint> surface_points(const Mesh& mesh,
                                         std::span<const SurfaceQuad> surface,
                                         double spacing_m);

}  // namespace magfsi::structure
