#include "structure/mesh/mesh_ends.h"

#include <algorithm>
#include <cmath>

#include "structure/mesh/bounds.h"

namespace magfsi::structure {

MeshEnds::MeshEnds(const Mesh& mesh, const Continues& continues)
    : mesh_(mesh), continues_(continues) {
    const Bounds box = bounds(mesh.nodes);
    low_m_ = box.low_m;
    high_m_ = box.high_m;
    slack_m_ = 1e-9 * box.diagonal_m();  // rounding of nodes
}

bool MeshEnds::hold(const SurfaceQuad& quad) const {
    const auto all_at = [&](std::size_t d, double plane_m) {
        return std::ranges::all_of(quad.node, [&](int node) {
            const Vec3& x = mesh_.nodes[static_cast<std::size_t>(node)];
            return std::abs(x[d] - plane_m) <= slack_m_;
        });
    };
    for (std::size_t d = 0; d < 3; ++d) {
        if (continues_[d] && (all_at(d, low_m_[d]) || all_at(d, high_m_[d]))) return true;
    }
    return false;
}

}  // namespace magfsi::structure
