// SPDX-License-Identifier: GPL-2.0-or-later
// Prediction of a run's wall time, memory and disk space on this machine: the work,
// counted before the run, times the seconds and bytes per unit of work that the
// calibration has measured.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/app/participants.h"
#include "adapters/scene/scene.h"

namespace magfsi::launch {

// Work of the fluid participant over the whole run, as the lattice Boltzmann solver does
// it.
struct FluidWork {
    // Cell updates per coupled step (on a refined grid those of finer levels count more,
    // by their measured cost), and cells at sides of the box that are not periodic.
    double cells = 0, wall_cells = 0;
    bool recursive_collision = false;
    bool single_precision = false;  // populations are stored in single precision
    // Rows of probes.csv for which the fluid computes something.
    double probe_rows = 0;
    double sum_rows = 0;  // probe rows that need a sum over all cells
    bool vorticity_files = false;
    double enstrophy_rows = 0;  // passes that compute vorticities, for probes or files
    double files = 0;           // number of field files written
    double bytes_per_cell = 0;  // size of one field file over the number of cells
    // Number of MPI ranks of the fluid.
    int ranks = 1;
};

// Work of the structure participant over the whole run.
struct StructureWork {
    double elements = 0, nodes = 0, markers = 0;
    double dipoles = 0;   // ordered pairs of magnetised elements that act on each other
    double substeps = 1;  // LAMMPS steps per coupled step
    double probe_rows = 0, files = 0;
    int ranks = 1;
};

// A path of static equilibria. Its number of iterations is known only when it runs.
struct PathWork {
    double points = 0;
    bool newton = true;  // Newton's method; false: damped motion
};

// Work of a whole run. `path` excludes `steps`: a path of equilibria has no time steps.
struct Work {
    double steps = 0;       // number of coupled steps
    double iterations = 1;  // iterations per coupled step (implicit scheme)
    std::optional<FluidWork> fluid;
    std::optional<StructureWork> structure;
    std::optional<PathWork> path;
};

// Counts the work of the scene on these ranks. Throws std::invalid_argument where the
// solvers refuse the scene, as explain() does.
Work work_of(const scene::Scene& scene, const bodies::Solids& solids, const Ranks& ranks);

// The calibration: seconds of this machine, measured once by `magfsi bench --calibrate`
// and kept in the user's cache folder.

// Measured speed of a fluid alone in a periodic box with the two-relaxation-time
// collision.
struct FluidSpeed {
    double cells = 0;
    int ranks = 1;
    bool single_precision = false;
    double s_per_cell_step = 0;  // wall time, all ranks at work
};

// Measured speed of Newton's method on one mesh.
struct NewtonSpeed {
    double nodes = 0;
    double s_per_point = 0;  // time per equilibrium of a path, all its iterations
};

// All figures of one calibration. The names of the members are the keys of
// calibration.json. Unless said otherwise a figure is the wall time on one rank, in
// seconds per unit of work.
struct Calibration {
    std::string machine, date;
    std::vector<FluidSpeed> fluid;
    std::vector<NewtonSpeed> newton;    // ascending by number of nodes
    double s_per_cell_regularized = 0;  // extra cost of recursive collisions
    double s_per_wall_cell = 0;         // extra cost of a cell at a non-periodic side
    double s_per_element_substep = 0;   // elements of type assumed_strain in LAMMPS
    double s_per_substep = 0;           // cost of a substep apart from elements
    double s_per_substep_exchange = 0;  // extra cost of a substep on two or more ranks
    double s_per_marker_substep = 0;    // drag force, computed by the structure
    double s_per_marker_step = 0;       // spreading and sampling, done by the fluid
    // Cost of a coupled step beyond the work of both sides: messages, cold caches of the
    // side that resumes, and core time taken by the side that waits. The plain figures
    // are for one rank on a core of its own, those named "shared" for more ranks than
    // cores.
    double s_per_coupled_step = 0, s_per_coupled_step_shared = 0;
    double s_per_coupled_cell = 0, s_per_coupled_cell_shared = 0;
    double s_per_cell_row = 0;        // sums over all cells for a probe row
    double s_per_cell_enstrophy = 0;  // vorticity of a cell for probes or files
    double s_per_probe_row = 0;       // one row of probes.csv
    double s_per_cell_byte = 0;       // writing of one byte of a fluid field file
    // Writing of one element to a structure field file.
    double s_per_element_file = 0;
    // Memory of a process [bytes], and what each cell, element or marker adds to it.
    double fluid_bytes = 0, coupled_fluid_bytes = 0, lammps_bytes = 0, newton_bytes = 0;
    double bytes_per_cell = 0;       // populations in double precision
    double bytes_per_cell_file = 0;  // added if fields are written
    double bytes_per_cell_curl = 0;  // added if vorticities are computed
    double bytes_per_element = 0, newton_bytes_per_element = 0, bytes_per_marker = 0;
    // Memory added if structure fields are written, independent of the number of
    // elements.
    double structure_file_bytes = 0;
};

// Name of this machine's processor and number of cores that this process may use. A
// calibration is valid only on the machine with the same text.
std::string machine();

// Reads the calibration of the user's cache folder. Returns nullopt if there is none, or
// if it belongs to another machine or version of magfsi.
std::optional<Calibration> read_calibration();

// Predicted cost of a run.
struct Prediction {
    // Wall time of the steps [s]; empty for damped motion to rest, whose number of steps
    // is unknown.
    std::optional<double> wall_s;
    std::optional<double> structure_s, fluid_s, exchange_s;  // parts of wall_s
    double structure_bytes = 0, fluid_bytes = 0;             // memory of all ranks
    double disk_bytes = 0;  // size of field files and probes
};

// Predicts the cost of the scene on these ranks. Returns nullopt without a calibration
// and for a fluid solver whose cost is not predicted (openfoam).
std::optional<Prediction> prediction(const scene::Scene& scene,
                                     const bodies::Solids& solids, const Ranks& ranks);

// JSON object with the keys wall_s (null if unknown), memory_bytes (by participant) and
// disk_bytes.
nlohmann::ordered_json to_json(const Prediction& prediction);

// Text of `magfsi explain` on the cost: the prediction, or the command that makes one
// possible.
std::string explain_cost(const scene::Scene& scene, const bodies::Solids& solids,
                         const Ranks& ranks);

}  // namespace magfsi::launch
