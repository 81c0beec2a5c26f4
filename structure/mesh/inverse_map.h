// Where a point lies in a trilinear hexahedron or on a bilinear quadrilateral.
#pragma once

#include <array>
#include <optional>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// Local coordinates xi of a point: the root of sum N_a(xi) x_a = point by Newton's method
// with step halving, from the centre. Empty where it finds none, which for a valid
// element means that the point is outside. The root may lie outside [-1, 1]^3.
std::optional<Vec3> inverse_map(const Positions8& nodes_m, const Vec3& point_m);

using Corners4 = std::array<Vec3, 4>;  // in cyclic order

// Coordinates (u, v) in [0, 1]^2, corner 0 at (0, 0) and corner 1 at (1, 0), of the point
// on the quadrilateral nearest to `point_m`: the foot of the perpendicular, or the
// nearest point of the four edges. Exact for plane parallelograms.
std::array<double, 2> nearest_on_quad(const Corners4& corners_m, const Vec3& point_m);

// Weights of the four corners at (u, v).
std::array<double, 4> quad_shape(double u, double v);

}  // namespace magfsi::structure
