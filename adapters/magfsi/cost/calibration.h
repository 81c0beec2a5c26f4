// Seconds of this machine, measured once by `magfsi bench --calibrate` and kept in the
// user's cache folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace magfsi::launch {

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
    double s_per_cell_regularized = 0;  // besides, of recursive_regularized
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

// $XDG_CACHE_HOME/magfsi/calibration.json, or ~/.cache/magfsi/calibration.json.
std::filesystem::path calibration_file();

// Nothing if there is none, or if it is of another machine or version of magfsi.
std::optional<Calibration> read_calibration();

}  // namespace magfsi::launch
