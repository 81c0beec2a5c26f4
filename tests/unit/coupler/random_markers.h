// Markers in random places of random hexahedra of a few nodes.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "coupler/immersed_boundary/markers.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler::testing {

inline constexpr std::size_t nodes = 40;

// Trilinear shape functions at a random point, on eight different nodes.
inline std::vector<Marker> random_markers(Random& random, std::size_t count) {
    std::vector<Marker> markers(count);
    for (Marker& marker : markers) {
        const Vec3 xi = random.vector(1);
        const int first = static_cast<int>(random.between(0, nodes));
        for (std::size_t a = 0; a < 8; ++a) {
            marker.node[a] = (first + 5 * static_cast<int>(a)) % static_cast<int>(nodes);
            marker.weight[a] = (1 + (a & 1 ? xi[0] : -xi[0])) *
                               (1 + (a & 2 ? xi[1] : -xi[1])) *
                               (1 + (a & 4 ? xi[2] : -xi[2])) / 8;
        }
        marker.volume_m3 = random.between(1e-12, 1e-11);
    }
    return markers;
}

inline std::vector<double> random_nodal(Random& random) {
    std::vector<double> values(3 * nodes);
    for (double& v : values) v = random.between(-0.5, 0.5);
    return values;
}

}  // namespace magfsi::coupler::testing
