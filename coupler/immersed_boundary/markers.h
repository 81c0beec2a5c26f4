// Lagrangian markers: material points of the body, carried by its elements through their
// shape functions, so that the fluid's grid and the body's mesh can be refined alone.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

// A marker as one structure rank sees it: eight nodes by local index, their weights
// (which add up to one), the volume of fluid that it moves and that of the fluid inside
// the body whose inertia is its force (enclosed_fluid.h) [m3].
struct Marker {
    std::array<int, 8> node{};
    std::array<double, 8> weight{};
    double volume_m3 = 0;
    double displaced_m3 = 0;
    int body = 0;
};

// Value of a nodal field (three numbers a node) at a marker.
inline Vec3 at_marker(const Marker& marker, const double* nodal) {
    Vec3 value{};
    for (std::size_t a = 0; a < 8; ++a) {
        const double* v = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        for (std::size_t d = 0; d < 3; ++d) value[d] += marker.weight[a] * v[d];
    }
    return value;
}

// Adds a marker's force to its nodes: the transpose of at_marker.
inline void to_nodes(const Marker& marker, const Vec3& force, double* nodal) {
    for (std::size_t a = 0; a < 8; ++a) {
        double* f = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        for (std::size_t d = 0; d < 3; ++d) f[d] += marker.weight[a] * force[d];
    }
}

}  // namespace magfsi::coupler
