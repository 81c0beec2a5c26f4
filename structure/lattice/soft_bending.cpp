#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/lattice/lattice.h"
#include "structure/lattice/springs.h"

namespace magfsi::structure {
namespace {

// With an in-plane edge of 0.9 h the coefficient is 2.4 h^2, still above the 2 h^2 that
// the full element has at r = 1: meshes with uneven edges need not be refused before
// that.
constexpr double shortest_edge = 0.9;

Eigen::Vector3d extents(const std::vector<Vec3>& nodes_m) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY);
    Eigen::Vector3d high = -low;
    for (const Vec3& node : nodes_m) {
        const Eigen::Vector3d x(node[0], node[1], node[2]);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    return high - low;
}

// Local direction of the element that lies closest to a body axis.
int edge_along(const ElementEdges& edges, int axis) {
    int best = 0;
    for (int d = 1; d < 3; ++d) {
        if (std::abs(edges.direction[d](axis)) > std::abs(edges.direction[best](axis))) {
            best = d;
        }
    }
    return best;
}

// Of the extents that tie for the smallest (a rod of square section), the one along which
// this element is shortest.
int thickness_edge(const ElementEdges& edges, const Eigen::Vector3d& extent) {
    int best = -1;
    for (int axis = 0; axis < 3; ++axis) {
        if (extent(axis) > extent.minCoeff() * (1 + 1e-6)) continue;
        const int edge = edge_along(edges, axis);
        if (best < 0 || edges.length_m[edge] < edges.length_m[best]) best = edge;
    }
    return best;
}

}  // namespace

void refuse_soft_bending(const std::vector<Vec3>& nodes_m,
                         const std::vector<Hexahedron>& elements) {
    const Eigen::Vector3d extent = extents(nodes_m);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const ElementEdges edges = element_edges(gather(nodes_m, elements[e]));
        const double thickness = edges.length_m[thickness_edge(edges, extent)];
        const double shortest = *std::ranges::min_element(edges.length_m);
        if (shortest < shortest_edge * thickness) {
            throw std::invalid_argument(fmt::format(
                "element {} has an in-plane edge of {:.4g} m, shorter than its thickness "
                "of {:.4g} m, where the element mean_f bends too softly: use element "
                "assumed_strain, more layers or fewer elements in the plane",
                e, shortest, thickness));
        }
    }
}

}  // namespace magfsi::structure
