// SPDX-License-Identifier: GPL-2.0-or-later
// The summary of a run, summary.json, and the record of its start, run.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace magfsi::output {

using Json = nlohmann::ordered_json;

// The way a run ended.
enum class Outcome { completed, diverged, lost_partner, stopped };

std::string_view to_text(Outcome outcome);  // "completed" ...

// A list of named values that keeps the order in which it was filled, also in the file.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

// The section "fluid" of summary.json.
struct FluidSummary {
    std::int64_t cells = 0;
    double mlups = 0;  // million cell updates per second of wall time
    double relaxation_time = 0;
    double spacing_m = 0;
    std::string collision, kernel;
};

// The section "structure".
struct StructureSummary {
    std::int64_t elements = 0;
    double ns_per_element_step = 0;
    int substeps_per_step = 1;  // at the end of the run
    std::int64_t substeps = 0;  // in the whole run
    // Smallest number per step, if the deformation or a retry has changed it.
    std::optional<int> fewest_substeps_per_step = {};
};

// The section "immersed_boundary": slip and leakage, measured at the markers with every
// probe row or a hundred times (coupler/immersed_boundary/slip.h).
struct BoundarySummary {
    std::int64_t markers = 0, samples = 0;
    // Rms of |U - V| over all samples, and that of the worst sample.
    double error_m_s = 0, largest_error_m_s = 0;
    double error = 0;  // error_m_s over the reference speed
    double leakage_m3_s = 0;
    // leakage_m3_s over the reference speed times a quarter of the surface.
    double leakage = 0;
    double marker_speed_m_s = 0, reference_speed_m_s = 0;
};

// The section "iterations": the number of iterations that the steps of an implicit scheme
// took.
struct IterationSummary {
    std::string acceleration;
    std::string measure;   // quantity that must converge
    double tolerance = 0;  // largest relative residual allowed
    std::int64_t steps = 0, iterations = 0;
    int most = 0;                  // most iterations in one step
    std::int64_t unconverged = 0;  // steps that continued unconverged
    double residual_sum = 0;       // sum of the steps' last residuals
    double worst_residual = 0;
};

// The section "energy_audit": extremes over all probe rows.
struct EnergySummary {
    double work_j = 0;      // largest work, or the energy at the start
    double residual_j = 0;  // largest magnitude of the residual
    // Largest increase of the energy of bodies and fluid that no work accounts for;
    // absent if the fluid is driven by its sides or by a body force.
    std::optional<double> gained_j;
    // Largest magnitude of the sum over markers of F . V dt for the impulses that the
    // fluid gets without a reaction on the bodies; absent if there are none.
    std::optional<double> layer_j;
};

// One participant's time in seconds over the whole run, mean over its ranks unless noted.
struct SideLoad {
    int ranks = 1;
    double working_s = 0;  // all tasks, waiting excluded
    double waiting_s = 0;  // waiting for the partner
    // Part of the work that the solver alone would need; that of the rank with the least.
    double solver_s = 0;
    // Part of the work that moves data between markers and cells; that of the rank with
    // most.
    double immersed_boundary_s = 0;
    double output_s = 0;   // part of the work for probes and files
    double imbalance = 1;  // largest work of a rank over the mean
    double steps_s = 0;    // all tasks, waiting included
    int max_ranks = 1;     // limit above which ranks have too little work
};

// One participant's report at the end of a run.
struct ParticipantReport {
    std::string name;
    Named<double> tasks;    // seconds on the root rank
    Named<double> waiting;  // seconds of the tasks waiting for the partner
    SideLoad load;
    std::int64_t memory_bytes = 0;  // all ranks
    double processor_s = 0;         // all ranks and threads, start-up included
    Named<std::string> versions;
    std::int64_t substeps = 0;    // total number, structure only
    Named<std::string> sections;  // JSON of each section by its key, "fluid" ...

    // Add a section; the participant that reports it decides which there are.
    void add(const FluidSummary& fluid);
    void add(const StructureSummary& structure);
    void add(const BoundarySummary& boundary);
    void add(const IterationSummary& iterations);
    void add(const EnergySummary& energy);

    std::string to_text() const;  // for the message to the partner
    static ParticipantReport from_text(const std::string& text);
};

// The content of summary.json.
struct Summary {
    std::string scene;
    std::uint64_t scene_hash = 0;
    Outcome outcome = Outcome::stopped;
    std::string cause;  // one sentence; empty when completed
    std::vector<std::string> effects, absent_effects;
    std::int64_t steps = 0;
    double simulated_s = 0, wall_s = 0;
    std::vector<ParticipantReport> participants;
    std::optional<double> coupling_overhead;        // share of the steps' time
    std::optional<double> immersed_boundary_share;  // share of the steps' time
    std::string advice;                             // better ranks, or empty
    Named<double> probes;                           // last row, by column
    std::optional<std::int64_t> restarted_at_step;
};

// The summary as JSON. scene_hash becomes a string of 16 hexadecimal digits, numbers that
// are not finite become null (JSON has no NaN), and sections that no participant reported
// are absent.
Json to_json(const Summary& summary);

// Writes the summary, indented, atomically. Throws FileError.
void write_summary(const std::filesystem::path& path, const Summary& summary);

// One start of a run, as run.json lists them: an entry for each start in the folder.
struct RunRecord {
    std::string scene;    // path of the scene file
    std::string command;  // command line as typed, or empty
    std::vector<std::string> overrides;
    std::string restart;
    std::string machine;
    Named<std::string> versions;
    Named<int> ranks;
};

// Adds a record to run.json, atomically. goes_on: the entries of earlier starts are kept.
// Throws FileError.
void add_record(const std::filesystem::path& path, const RunRecord& record, bool goes_on);

}  // namespace magfsi::output
