#include "structure/equilibrium/node_levels.h"

#include <algorithm>
#include <cmath>

namespace magfsi::structure {
namespace {

struct Extent {
    int axis = 0;
    double low = 0, high = 0;
};

Extent longest_side(const std::vector<Vec3>& nodes) {
    Extent longest;
    for (int d = 0; d < 3; ++d) {
        const auto [low, high] =
            std::ranges::minmax(nodes, {}, [d](const Vec3& node) { return node[d]; });
        if (high[d] - low[d] > longest.high - longest.low) {
            longest = {d, low[d], high[d]};
        }
    }
    return longest;
}

// Elements of each node.
std::vector<std::vector<int>> elements_of_nodes(const Mesh& mesh) {
    std::vector<std::vector<int>> out(mesh.nodes.size());
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int node : mesh.elements[e]) out[node].push_back(static_cast<int>(e));
    }
    return out;
}

// The nodes not yet reached that lie lowest along the axis, to a hundredth of the side.
std::vector<int> lowest_unreached(const Mesh& mesh, const std::vector<int>& level,
                                  const std::vector<std::vector<int>>& elements,
                                  const Extent& side) {
    double lowest = INFINITY;
    const auto open = [&](std::size_t n) { return level[n] < 0 && !elements[n].empty(); };
    for (std::size_t n = 0; n < level.size(); ++n) {
        if (open(n)) lowest = std::min(lowest, mesh.nodes[n][side.axis]);
    }
    const double limit = lowest + 0.01 * (side.high - side.low);
    std::vector<int> out;
    for (std::size_t n = 0; n < level.size(); ++n) {
        if (open(n) && mesh.nodes[n][side.axis] <= limit) {
            out.push_back(static_cast<int>(n));
        }
    }
    return out;
}

}  // namespace

NodeLevels node_levels(const Mesh& mesh) {
    const auto elements = elements_of_nodes(mesh);
    const Extent side = longest_side(mesh.nodes);
    NodeLevels out;
    out.level.assign(mesh.nodes.size(), -1);
    out.slot.assign(mesh.nodes.size(), 0);
    // Breadth first; a body in several pieces starts again with the next piece.
    for (;;) {
        std::vector<int> front = lowest_unreached(mesh, out.level, elements, side);
        if (front.empty()) return out;
        while (!front.empty()) {
            const int level = static_cast<int>(out.size.size());
            for (std::size_t i = 0; i < front.size(); ++i) {
                out.level[front[i]] = level;
                out.slot[front[i]] = static_cast<int>(i);
            }
            out.size.push_back(static_cast<int>(front.size()));
            std::vector<int> next;
            for (int node : front) {
                for (int element : elements[node]) {
                    for (int other : mesh.elements[element]) {
                        if (out.level[other] >= 0) continue;
                        out.level[other] = level + 1;
                        next.push_back(other);
                    }
                }
            }
            front = std::move(next);
        }
    }
}

}  // namespace magfsi::structure
