// SPDX-License-Identifier: GPL-2.0-or-later
// A structure of the user's own beside a fluid participant: all of its program but the
// solver. The scene says coupling.structure: own (docs/own_structure.md).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "coupler/scheme/structure_coupling.h"

namespace magfsi {

struct OwnStructure {
    std::unique_ptr<coupler::StructureSolver> solver;
    std::vector<coupler::Marker> markers;  // of this rank
    // Columns of probes.csv before the fluid's, named with their units, and their values
    // of the present; both on rank 0, which alone calls `values`.
    std::vector<std::string> columns{};
    std::function<std::vector<double>()> values{};
};

// A marker in a node. volume_m3: of the fluid that it moves, the node's share of a
// sheet's area times the fluid's spacing, or of a body's volume.
coupler::Marker node_marker(int node, double volume_m3);

// On every rank, with the coupled step of the scene.
using MakeStructure = std::function<OwnStructure(const scene::Scene&, double step_s)>;

// The main function. Returns the exit code.
int run_structure(const std::string& description, int argc, char** argv,
                  const MakeStructure& make);

}  // namespace magfsi
