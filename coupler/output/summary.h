// How a run went, as summary.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace magfsi::output {

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
    // Where the deformation, or a retry, has changed that number during the run:
    std::optional<int> fewest_substeps_per_step = {};
    std::optional<std::int64_t> substeps = {};  // in the whole run
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
    // Largest rise of the energy of bodies and fluid that no work has paid for; not told
    // where the fluid is driven by its sides or a force.
    std::optional<double> gained_j;
};

// Of one participant; seconds are means over its ranks.
struct LoadSummary {
    double working_s = 0;
    double waiting_s = 0;  // for the partner
    double imbalance = 1;  // largest work of a rank over the mean
};

struct Summary {
    std::string scene;
    std::uint64_t scene_hash = 0;
    Outcome outcome = Outcome::stopped;
    std::string cause;  // one sentence; empty when completed
    std::vector<std::string> effects, absent_effects;
    Named<std::string> versions;
    Named<int> ranks;  // by participant
    std::int64_t steps = 0;
    std::int64_t substeps = 0;  // of the structure, in the whole run
    double simulated_s = 0, wall_s = 0;
    Named<Named<double>> tasks;    // seconds by participant and task
    Named<Named<double>> waiting;  // of them, for the partner
    Named<LoadSummary> load;
    std::optional<double> coupling_overhead;        // share of the steps' time
    std::optional<double> immersed_boundary_share;  // the same
    std::string advice;                             // empty where there is none
    std::optional<IterationSummary> iterations;
    std::optional<FluidSummary> fluid;
    std::optional<StructureSummary> structure;
    std::optional<BoundarySummary> immersed_boundary;
    std::optional<EnergySummary> energy_audit;
    Named<std::int64_t> memory_bytes;  // by participant, all its ranks
    Named<double> probes;              // last values by column
    nlohmann::ordered_json extra = nlohmann::ordered_json::object();
};

// Keys as in the struct, save: scene_hash is 16 hexadecimal digits in a string; what is
// not finite becomes null, for JSON knows no NaN; an absent fluid, structure or
// immersed boundary has no key.
nlohmann::ordered_json to_json(const Summary& summary);

// Indented, atomic. Throws FileError.
void write_summary(const std::filesystem::path& path, const Summary& summary);

}  // namespace magfsi::output
