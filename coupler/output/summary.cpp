#include "coupler/output/summary.h"

#include <fmt/format.h>

#include "coupler/output/atomic_file.h"

namespace magfsi::output {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json object(const Named<T>& entries) {
    Json out = Json::object();
    for (const auto& [name, value] : entries) out[name] = value;
    return out;
}

Json object(const Named<Named<double>>& participants) {
    Json out = Json::object();
    for (const auto& [name, tasks] : participants) out[name] = object(tasks);
    return out;
}

Json object(const Named<LoadSummary>& participants) {
    Json out = Json::object();
    for (const auto& [name, load] : participants) {
        out[name] = {{"working_s", load.working_s},
                     {"waiting_s", load.waiting_s},
                     {"imbalance", load.imbalance}};
    }
    return out;
}

Json object(const FluidSummary& fluid) {
    return {{"cells", fluid.cells},
            {"mlups", fluid.mlups},
            {"relaxation_time", fluid.relaxation_time},
            {"spacing_m", fluid.spacing_m},
            {"collision", fluid.collision},
            {"kernel", fluid.kernel}};
}

Json object(const StructureSummary& structure) {
    Json out{{"elements", structure.elements},
             {"ns_per_element_step", structure.ns_per_element_step},
             {"substeps_per_step", structure.substeps_per_step}};
    if (structure.fewest_substeps_per_step)
        out["fewest_substeps_per_step"] = *structure.fewest_substeps_per_step;
    return out;
}

Json object(const BoundarySummary& b) {
    return {{"markers", b.markers},
            {"samples", b.samples},
            {"no_slip_error", b.error},
            {"no_slip_error_m_s", b.error_m_s},
            {"largest_no_slip_error_m_s", b.largest_error_m_s},
            {"leakage", b.leakage},
            {"leakage_m3_s", b.leakage_m3_s},
            {"marker_speed_m_s", b.marker_speed_m_s},
            {"reference_speed_m_s", b.reference_speed_m_s}};
}

Json object(const EnergySummary& e) {
    const auto share = [&](double energy_j) { return energy_j / e.work_j; };
    Json out{{"work_j", e.work_j},
             {"residual_j", e.residual_j},
             {"residual", share(e.residual_j)}};
    if (e.gained_j) {
        out["gained_j"] = *e.gained_j;
        out["gained"] = share(*e.gained_j);
    }
    return out;
}

Json object(const IterationSummary& i) {
    const double steps = i.steps > 0 ? static_cast<double>(i.steps) : 1;
    return {{"acceleration", i.acceleration},
            {"measure", i.measure},
            {"tolerance", i.tolerance},
            {"mean", static_cast<double>(i.iterations) / steps},
            {"most", i.most},
            {"unconverged_steps", i.unconverged},
            {"mean_residual", i.residual_sum / steps},
            {"worst_residual", i.worst_residual}};
}

}  // namespace

std::string_view to_text(Outcome outcome) {
    switch (outcome) {
        case Outcome::completed:
            return "completed";
        case Outcome::diverged:
            return "diverged";
        case Outcome::lost_partner:
            return "lost_partner";
        case Outcome::stopped:
            return "stopped";
    }
    return "stopped";
}

Json to_json(const Summary& summary) {
    Json out;
    out["scene"] = summary.scene;
    out["scene_hash"] = fmt::format("{:016x}", summary.scene_hash);
    out["outcome"] = to_text(summary.outcome);
    out["cause"] = summary.cause;
    out["effects"] = summary.effects;
    out["absent_effects"] = summary.absent_effects;
    out["versions"] = object(summary.versions);
    out["ranks"] = object(summary.ranks);
    out["steps"] = summary.steps;
    out["substeps"] = summary.substeps;
    out["simulated_s"] = summary.simulated_s;
    out["wall_s"] = summary.wall_s;
    out["tasks"] = object(summary.tasks);
    out["waiting"] = object(summary.waiting);
    out["load"] = object(summary.load);
    if (summary.coupling_overhead) out["coupling_overhead"] = *summary.coupling_overhead;
    if (summary.immersed_boundary_share)
        out["immersed_boundary_share"] = *summary.immersed_boundary_share;
    out["advice"] = summary.advice;
    if (summary.iterations) out["iterations"] = object(*summary.iterations);
    if (summary.fluid) out["fluid"] = object(*summary.fluid);
    if (summary.structure) out["structure"] = object(*summary.structure);
    if (summary.immersed_boundary)
        out["immersed_boundary"] = object(*summary.immersed_boundary);
    if (summary.energy_audit) out["energy_audit"] = object(*summary.energy_audit);
    out["memory_bytes"] = object(summary.memory_bytes);
    out["probes"] = object(summary.probes);
    out["extra"] = summary.extra;
    return out;
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
    // A cause may quote a file's bytes; what is not UTF-8 is replaced, not thrown at.
    const auto text =
        to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace);
    write_atomically(path, text + '\n');
}

}  // namespace magfsi::output
