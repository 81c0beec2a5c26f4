// SPDX-License-Identifier: GPL-2.0-or-later
// Packing of elements into the batches of the kernels (kernel_data.h).
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "structure/lattice/element_kernel.h"

namespace magfsi::structure {

// The soft elements, all in a body without rigid parts, and their nodes.
struct SoftElements {
    std::vector<int> number;
    std::vector<std::array<int, 8>> nodes;
};
inline SoftElements soft_elements(const Lattice& lattice) {
    SoftElements soft;
    for (std::size_t e = 0; e < lattice.elements.size(); ++e) {
        if (!lattice.element_rigid.empty() && lattice.element_rigid[e] >= 0) continue;
        soft.number.push_back(static_cast<int>(e));
        soft.nodes.push_back(lattice.elements[e]);
    }
    return soft;
}

inline std::size_t batch_count(std::size_t elements) {
    return (elements + batch_lanes - 1) / batch_lanes;
}

// Node indices in the order [batch][node][lane]. Lanes past the last element repeat it.
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

// Values of value(element, entry) in the order [batch][entry][lane]. Lanes past the last
// element repeat it.
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

// Entry k of the data that the viscous kernel reads for a brick: volume, gradient,
// metric.
inline double brick_entry(const ElementModes& modes, std::size_t k) {
    // The non-zero entries: B_x of the mode x, B_y of y, B_z of z, in rows 0, 1 and 3 of
    // the gradient.
    constexpr std::array<std::size_t, 3> diagonal{0, 4, 11};
    if (k == 0) return modes.volume;
    if (k < 4) return modes.gradient[diagonal[k - 1]];
    return modes.metric[brick_metric_entries[k - 4]];
}

// Entry k for a general element: volume, gradient, metric, offsets.
inline double general_entry(const ElementModes& modes, std::size_t k) {
    if (k == 0) return modes.volume;
    if (k < 22) return modes.gradient[k - 1];
    if (k < 31) return modes.metric[k - 22];
    return modes.offset[k - 31];
}

// Entry k of ViscousBatches::data.
inline double viscous_entry(const ElementModes& modes, bool brick, std::size_t k) {
    return brick ? brick_entry(modes, k) : general_entry(modes, k);
}

}  // namespace magfsi::structure
