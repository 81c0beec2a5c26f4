// SPDX-License-Identifier: GPL-2.0-or-later
// How a run went, as summary.json.
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

enum class Outcome { completed, diverged, lost_partner, stopped };

std::string_view to_text(Outcome outcome);  // "completed" ...

// In the order in which it was filled, and so in the file.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

struct FluidSummary {
    std::int64_t cells = 0;
    double mlups = 0;  // million cell updates a second of wall time
    double relaxation_time = 0;
    double spacing_m = 0;
    std::string collision, kernel;
};

struct StructureSummary {
    std::int64_t elements = 0;
    double ns_per_element_step = 0;
    int substeps_per_step = 1;  // at the end of the run
    std::int64_t substeps = 0;  // in the whole run
    // Where the deformation, or a retry, has changed their number per step:
    std::optional<int> fewest_substeps_per_step = {};
};

// How well the immersed boundary held, measured at the markers (every probe row, or a
// hundred times): coupler/immersed_boundary/slip.h. Shares are of the reference speed.
struct BoundarySummary {
    std::int64_t markers = 0, samples = 0;
    double error_m_s = 0, largest_error_m_s = 0;  // rms of |U - V|; of the worst sample
    double error = 0;
    double leakage_m3_s = 0;
    double leakage = 0;  // of the reference speed through a quarter of the surface
    double marker_speed_m_s = 0, reference_speed_m_s = 0;
};

// Of an implicit scheme: what its steps took until they converged.
struct IterationSummary {
    std::string acceleration;
    std::string measure;   // what is to stay the same from one iteration to the next
    double tolerance = 0;  // relative
    std::int64_t steps = 0, iterations = 0;
    int most = 0;                  // iterations in a step
    std::int64_t unconverged = 0;  // steps that went on all the same
    double residual_sum = 0;       // of the last residuals of all steps, for their mean
    double worst_residual = 0;
};

// What the energy audit found, over all rows of the probes.
struct EnergySummary {
    double work_j = 0;      // the largest work, or the energy of the start
    double residual_j = 0;  // largest magnitude
    // Largest rise of the energy of bodies and fluid that no work has paid for; absent
    // where the fluid is driven by its sides or a force.
    std::optional<double> gained_j;
    // Of the sum over markers of F . V dt by what the fluid is given besides the bodies'
    // forces: the largest magnitude; absent where it is given nothing.
    std::optional<double> layer_j;
};

// One participant's time over the whole run. Seconds are means over its ranks, but for
// two.
struct SideLoad {
    int ranks = 1;
    double working_s = 0;  // all tasks, less waiting
    double waiting_s = 0;  // for the partner
    double solver_s = 0;   // of the work: what the solver would need alone; least rank
    double immersed_boundary_s = 0;  // of the work: markers from and to cells; most rank
    double output_s = 0;             // of the work: probes and files
    double imbalance = 1;            // largest work of a rank over the mean
    double steps_s = 0;  // all tasks: what the steps took as this side saw them
    int max_ranks = 1;   // beyond which a rank has too little to do
};

// What a participant reports at the end.
struct ParticipantReport {
    std::string name;
    Named<double> tasks;    // seconds on the root rank
    Named<double> waiting;  // of them, for the partner
    SideLoad load;
    std::int64_t memory_bytes = 0;  // all ranks
    Named<std::string> versions;
    std::int64_t substeps = 0;    // of a structure, in the whole run
    Named<std::string> sections;  // JSON by its key in summary.json: "fluid", ...

    void add(const FluidSummary& fluid);
    void add(const StructureSummary& structure);
    void add(const BoundarySummary& boundary);
    void add(const IterationSummary& iterations);
    void add(const EnergySummary& energy);

    std::string to_text() const;  // for the partner
    static ParticipantReport from_text(const std::string& text);
};

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
    std::optional<double> immersed_boundary_share;  // the same
    std::string advice;                             // empty where there is none
    Named<double> probes;                           // last values by column
    std::optional<std::int64_t> restarted_at_step;
};

// scene_hash is 16 hexadecimal digits in a string; what is not finite becomes null, for
// JSON knows no NaN; a section that no participant has is no key.
Json to_json(const Summary& summary);

// Indented, atomic. Throws FileError.
void write_summary(const std::filesystem::path& path, const Summary& summary);

// What was run, as run.json keeps it: a list with an entry for each start in the folder.
struct RunRecord {
    std::string scene;    // the file
    std::string command;  // empty where nobody typed one
    std::vector<std::string> overrides;
    std::string restart;
    std::string machine;
    Named<std::string> versions;
    Named<int> ranks;
};

// Atomic. goes_on: the earlier entries stay. Throws FileError.
void add_record(const std::filesystem::path& path, const RunRecord& record, bool goes_on);

}  // namespace magfsi::output
