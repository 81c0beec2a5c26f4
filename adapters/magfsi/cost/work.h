// What a scene asks of the machine, counted before it runs.
#pragma once

#include <optional>

#include "adapters/magfsi/ranks.h"
#include "adapters/scene/scene.h"

namespace magfsi::launch {

struct FluidWork {
    double cells = 0, wall_cells = 0;  // at sides that are not periodic
    bool recursive_regularized = false;
    bool single_precision = false;  // of populations in memory
    double probe_rows = 0;
    double sum_rows = 0;  // of them, each a pass over all cells
    bool vorticity_files = false;
    double enstrophy_rows = 0;  // also vorticities in files
    double files = 0;
    double bytes_a_cell = 0;  // of a file
    int ranks = 1;
};

struct StructureWork {
    double elements = 0, nodes = 0, markers = 0;
    double substeps = 1;  // in a coupled step
    double probe_rows = 0, files = 0;
    int ranks = 1;
};

// Paths of equilibria, whose steps show only when they run.
struct PathWork {
    double points = 0;
    bool newton = true;  // else by damped motion
};

struct Work {
    double steps = 0;       // coupled
    double iterations = 1;  // of a step
    bool at_once = false;   // both sides work at the same time
    std::optional<FluidWork> fluid;
    std::optional<StructureWork> structure;
    std::optional<PathWork> path;
};

// Throws as explain does, on what only mesh and solvers can refuse.
Work work_of(const scene::Scene& scene, const Ranks& ranks);

}  // namespace magfsi::launch
