// SPDX-License-Identifier: GPL-2.0-or-later
// A program with the user's own structure beside a fluid participant: this file provides
// all of it except the solver. The scene says coupling.structure: own
// (docs/own_structure.md).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "coupler/scheme/structure_coupling.h"

namespace magfsi {

// The user's solver with its markers and probes.
struct OwnStructure {
    std::unique_ptr<coupler::StructureSolver> solver;
    std::vector<coupler::Marker> markers;  // markers of this rank
    // Columns of probes.csv before the fluid's, named with their units ("tip_x[m]"), and
    // a function that returns their present values. Both are needed on rank 0 only, which
    // alone calls `values`.
    std::vector<std::string> columns{};
    std::function<std::vector<double>()> values{};
};

// Makes a marker that sits in one node. `volume_m3` is the volume of fluid that the
// marker moves [m3]: the node's share of a sheet's area times the fluid's spacing, or of
// a body's volume.
coupler::Marker node_marker(int node, double volume_m3);

// Factory of the structure; called on every rank with the coupled step of the scene [s].
using MakeStructure = std::function<OwnStructure(const scene::Scene&, double step_s)>;

// Main function of the program. Returns the exit code.
int run_structure(const std::string& description, int argc, char** argv,
                  const MakeStructure& make);

}  // namespace magfsi
