// Memory of batches: eight elements a row of lanes, 64-byte aligned.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "structure/lattice/element_batches.h"

namespace magfsi::structure {

struct alignas(64) Lanes {
    double lane[batch_lanes];
};
struct alignas(64) NodeLanes {
    int lane[2 * batch_lanes];  // two nodes
};

inline std::size_t batch_count(std::size_t elements) {
    return (elements + batch_lanes - 1) / batch_lanes;
}

// [batch][node][lane]; lanes past the last element repeat it.
inline std::vector<NodeLanes> pack_nodes(std::span<const std::array<int, 8>> nodes) {
    std::vector<NodeLanes> out(batch_count(nodes.size()) * 4);
    for (std::size_t position = 0; position < out.size() * 2; ++position) {
        const auto& element = nodes[std::min(position, nodes.size() - 1)];
        const std::size_t batch = position / batch_lanes;
        for (std::size_t a = 0; a < 8; ++a) {
            out[batch * 4 + a / 2].lane[(a % 2) * batch_lanes + position % batch_lanes] =
                element[a];
        }
    }
    return out;
}

// [batch][entry][lane] of value(element, entry).
template <class Value>
std::vector<Lanes> pack_lanes(std::span<const int> elements, std::size_t entries,
                              const Value& value) {
    std::vector<Lanes> out(batch_count(elements.size()) * entries);
    if (entries == 0) return out;
    for (std::size_t row = 0; row < out.size(); ++row) {
        for (std::size_t lane = 0; lane < batch_lanes; ++lane) {
            const std::size_t position = row / entries * batch_lanes + lane;
            const int element = elements[std::min(position, elements.size() - 1)];
            out[row].lane[lane] = value(element, row % entries);
        }
    }
    return out;
}

}  // namespace magfsi::structure
