// Axis-parallel bounding boxes [m].
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct Bounds {
    Vec3 low_m{INFINITY, INFINITY, INFINITY};
    Vec3 high_m{-INFINITY, -INFINITY, -INFINITY};

    void add(const Vec3& x) {
        for (int d = 0; d < 3; ++d) {
            low_m[d] = std::min(low_m[d], x[d]);
            high_m[d] = std::max(high_m[d], x[d]);
        }
    }
    bool holds(const Vec3& x, double margin_m = 0) const {
        return distance_m(x) <= margin_m;
    }
    // Of a point outside to the box; 0 inside.
    double distance_m(const Vec3& x) const {
        Vec3 gap{};
        for (int d = 0; d < 3; ++d) {
            gap[d] = std::max({0.0, low_m[d] - x[d], x[d] - high_m[d]});
        }
        return std::hypot(gap[0], gap[1], gap[2]);
    }
    bool meets(const Bounds& other) const {
        for (int d = 0; d < 3; ++d) {
            if (low_m[d] > other.high_m[d] || other.low_m[d] > high_m[d]) return false;
        }
        return true;
    }
    double diagonal_m() const {
        return std::hypot(high_m[0] - low_m[0], high_m[1] - low_m[1],
                          high_m[2] - low_m[2]);
    }
};

// Of all nodes, or of the nodes `which`.
inline Bounds bounds(const std::vector<Vec3>& nodes_m) {
    Bounds out;
    for (const Vec3& x : nodes_m) out.add(x);
    return out;
}
inline Bounds bounds(const std::vector<Vec3>& nodes_m, std::span<const int> which) {
    Bounds out;
    for (const int node : which) out.add(nodes_m[node]);
    return out;
}

}  // namespace magfsi::structure
