// SPDX-License-Identifier: GPL-2.0-or-later
// The quantities that probes.bodies may name: for each its columns of probes.csv and the
// function that evaluates them for one body.
#pragma once

#include <cstddef>
#include <vector>

#include "adapters/solvers/bodies/probe_row.h"

namespace magfsi::bodies {

// Values of some columns of probes.csv, in the units that the columns' names give.
using Row = std::vector<double>;

// The state of one body at one time, as the functions of BodyProbe see it. All members
// refer to data of the caller and are valid during the call only.
struct BodySample {
    const NodalState& nodes;  // the nodes of all bodies
    const BodyLoads& loads;   // the loads on this body
    // Range of this body's nodes in `nodes`: number of the first node, number of nodes.
    std::size_t first, count;
    const std::vector<structure::MaterialPoint>& centre_line;  // numbered within the body
    // Positions of this body's nodes at step 0 [m]; `count` entries.
    const Vec3* start_m;
};

// A quantity that is measured for each body. A new quantity takes one entry in
// body_quantities.cpp and one value of scene::BodyQuantity with its word.
struct BodyProbe {
    scene::BodyQuantity quantity;
    // Names of the columns with their units; the body's name is put before them.
    std::vector<const char*> columns;
    Load needs;  // the load that must be collected for it
    // One value for each column. Null for quantities whose columns depend on the scene:
    // ProbeRow evaluates those itself.
    Row (*values)(const BodySample& body);
};

// The entry of a quantity. It refers to a static table.
const BodyProbe& body_probe(scene::BodyQuantity quantity);

// Position [m] of a material point of one body. nodes_m: positions of the nodes of all
// bodies; first_node: number of this body's node 0 among them.
Vec3 position(const structure::MaterialPoint& point, const std::vector<Vec3>& nodes_m,
              std::size_t first_node);

// Mean of a nodal field over the nodes of one body, weighted with their masses. field:
// one vector for each node of all bodies, in the order of body.nodes.
Vec3 mass_weighted_mean(const BodySample& body, const std::vector<Vec3>& field);

}  // namespace magfsi::bodies
