#include "structure/mesh/centre_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/mesh/bounds.h"

namespace magfsi::structure {

std::vector<MaterialPoint> line_through(const Mesh& mesh, std::span<const int> nodes) {
    const Bounds box = bounds(mesh.nodes, nodes);
    int along = 0;
    for (int d = 1; d < 3; ++d) {
        if (box.high_m[d] - box.low_m[d] > box.high_m[along] - box.low_m[along])
            along = d;
    }
    std::vector<MaterialPoint> of_node(mesh.nodes.size());
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int a = 0; a < 8; ++a) {
            MaterialPoint& point = of_node[mesh.elements[e][a]];
            if (point.element >= 0) continue;
            point.node = mesh.elements[e];
            point.weight[a] = 1;
            point.element = static_cast<int>(e);
        }
    }
    std::vector<int> ordered(nodes.begin(), nodes.end());
    std::ranges::stable_sort(ordered, {},
                             [&](int node) { return mesh.nodes[node][along]; });
    std::vector<MaterialPoint> line;
    for (const int node : ordered) {
        if (of_node[node].element < 0) {
            throw std::invalid_argument(fmt::format(
                "node {} of a line belongs to no element; a line runs through the body",
                node));
        }
        line.push_back(of_node[node]);
    }
    return line;
}

}  // namespace magfsi::structure
