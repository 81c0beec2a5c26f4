// SPDX-License-Identifier: GPL-2.0-or-later
// What a word of probes.bodies stands for: its columns, and their values of a body.
#pragma once

#include <cstddef>
#include <vector>

#include "adapters/bodies/probe_row.h"

namespace magfsi::bodies {

using Row = std::vector<double>;

// One body of a sample.
struct BodySample {
    const NodalState& nodes;
    const BodyLoads& loads;
    std::size_t first, count;  // of its nodes
    const std::vector<structure::MaterialPoint>& centre_line;
    const Vec3* start_m;  // of its nodes at step 0
};

// A probe of a body: a line here and its word beside scene::BodyQuantity.
struct BodyProbe {
    scene::BodyQuantity quantity;
    std::vector<const char*> columns;
    Load needs;
    Row (*values)(const BodySample& body);
};

const BodyProbe& body_probe(scene::BodyQuantity quantity);

// Of a point of the mesh whose nodes begin there.
Vec3 position(const structure::MaterialPoint& point, const std::vector<Vec3>& nodes_m,
              std::size_t first_node);

Vec3 cross(const Vec3& a, const Vec3& b);

// field: of all nodes, those of other bodies, too.
Vec3 mass_weighted_mean(const BodySample& body, const std::vector<Vec3>& field);

}  // namespace magfsi::bodies
