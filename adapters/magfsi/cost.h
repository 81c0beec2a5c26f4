// SPDX-License-Identifier: GPL-2.0-or-later
// What a scene will cost on this machine: its work, counted before it runs, times the
// seconds and bytes that the calibration has measured.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/magfsi/participants.h"
#include "adapters/scene/scene.h"

namespace magfsi::launch {

struct FluidWork {
    double cells = 0, wall_cells = 0;  // at sides that are not periodic
    bool recursive_collision = false;
    bool single_precision = false;  // of populations in memory
    double probe_rows = 0;
    double sum_rows = 0;  // of them, each a pass over all cells
    bool vorticity_files = false;
    double enstrophy_rows = 0;  // also vorticities in files
    double files = 0;
    double bytes_per_cell = 0;  // of a file
    int ranks = 1;
};

struct StructureWork {
    double elements = 0, nodes = 0, markers = 0;
    double dipoles = 0;   // that act on another, each on each
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
    bool parallel = false;  // both sides work at the same time
    std::optional<FluidWork> fluid;
    std::optional<StructureWork> structure;
    std::optional<PathWork> path;
};

// Throws as explain does, on what only mesh and solvers can refuse.
Work work_of(const scene::Scene& scene, const Ranks& ranks);

// The calibration: seconds of this machine, measured once by `magfsi bench --calibrate`
// and kept in the user's cache folder.

// A fluid alone, in a periodic box, of two relaxation times.
struct FluidSpeed {
    double cells = 0;
    int ranks = 1;
    bool single_precision = false;
    double s_per_cell_step = 0;  // wall time, all ranks at work
};

// Newton's method on a mesh.
struct NewtonSpeed {
    double nodes = 0;
    double s_per_point = 0;  // of a path: some iterations
};

struct Calibration {
    std::string machine, date;
    std::vector<FluidSpeed> fluid;
    std::vector<NewtonSpeed> newton;    // by nodes, ascending
    double s_per_cell_regularized = 0;  // besides, of recursive collisions
    double s_per_wall_cell = 0;         // besides, at a side that is not periodic
    double s_per_element_substep = 0;   // of assumed_strain elements in LAMMPS
    double s_per_substep = 0;           // whatever the elements
    double s_per_substep_exchange = 0;  // besides, on more ranks than one
    double s_per_marker_substep = 0;    // drag, by the structure
    double s_per_marker_step = 0;       // spread and sampled, by the fluid
    // Messages, and what waiting adds to the work: the side that goes on has cold caches,
    // and one that waits takes time from its core. On one rank each; with more ranks than
    // cores.
    double s_per_coupled_step = 0, s_per_coupled_step_shared = 0;
    double s_per_coupled_cell = 0, s_per_coupled_cell_shared = 0;
    double s_per_cell_row = 0;        // probes of the fluid: sums
    double s_per_cell_enstrophy = 0;  // and the enstrophy
    double s_per_probe_row = 0;       // of anything
    double s_per_cell_byte = 0;       // of files
    double s_per_element_file = 0;
    // Memory of a process, and what each thing in it adds.
    double fluid_bytes = 0, coupled_fluid_bytes = 0, lammps_bytes = 0, newton_bytes = 0;
    double bytes_per_cell = 0;       // in double precision
    double bytes_per_cell_file = 0;  // where fields are written
    double bytes_per_cell_curl = 0;  // where vorticities are needed
    double bytes_per_element = 0, newton_bytes_per_element = 0, bytes_per_marker = 0;
    double structure_file_bytes = 0;  // where fields are written, whatever the elements
};

// This machine in words: its processor and the cores that may be used.
std::string machine();

// Nothing if there is none, or if it is of another machine or version of magfsi.
std::optional<Calibration> read_calibration();

struct Prediction {
    std::optional<double> wall_s;  // of the steps; nothing for unknown motion to rest
    std::optional<double> structure_s, fluid_s, exchange_s;  // its parts
    double structure_bytes = 0, fluid_bytes = 0;             // memory of all ranks
    double disk_bytes = 0;                                   // fields and probes
};

// Nothing without a calibration, and for a fluid whose cost is not predicted.
std::optional<Prediction> prediction(const scene::Scene& scene, const Ranks& ranks);

// With wall_s (null where there is none), memory_bytes by participant, disk_bytes.
nlohmann::ordered_json to_json(const Prediction& prediction);

// For explain: the prediction, or how to get one.
std::string explain_cost(const scene::Scene& scene, const Ranks& ranks);

}  // namespace magfsi::launch
