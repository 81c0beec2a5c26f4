// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/output/summary.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tuple>

#include "coupler/output/file.h"

namespace magfsi::output {
namespace {

// A JSON object of named values, in their order.
template <class T>
Json object(const Named<T>& entries) {
    Json out = Json::object();
    for (const auto& [name, value] : entries) out[name] = value;
    return out;
}

// All fields of a load, once for both sending and receiving.
template <class Load>
auto fields(Load& load) {
    return std::tie(load.ranks, load.working_s, load.waiting_s, load.solver_s,
                    load.immersed_boundary_s, load.output_s, load.imbalance, load.steps_s,
                    load.max_ranks);
}

template <class Report>
auto fields_of_report(Report& report) {
    return std::tie(report.name, report.tasks, report.waiting, report.memory_bytes,
                    report.processor_s, report.versions, report.substeps,
                    report.sections);
}

template <class... T>
void read(const Json& json, std::tuple<T&...> into) {
    into = json.get<std::tuple<T...>>();
}

void add_section(Named<std::string>& sections, const char* key, const Json& values) {
    sections.emplace_back(key, values.dump());
}

}  // namespace

void ParticipantReport::add(const FluidSummary& fluid) {
    add_section(sections, "fluid",
                {{"cells", fluid.cells},
                 {"mlups", fluid.mlups},
                 {"relaxation_time", fluid.relaxation_time},
                 {"spacing_m", fluid.spacing_m},
                 {"collision", fluid.collision},
                 {"kernel", fluid.kernel}});
}

void ParticipantReport::add(const StructureSummary& structure) {
    Json out{{"elements", structure.elements},
             {"ns_per_element_step", structure.ns_per_element_step},
             {"substeps_per_step", structure.substeps_per_step}};
    substeps = structure.substeps;
    if (structure.fewest_substeps_per_step)
        out["fewest_substeps_per_step"] = *structure.fewest_substeps_per_step;
    add_section(sections, "structure", out);
}

void ParticipantReport::add(const BoundarySummary& b) {
    add_section(sections, "immersed_boundary",
                {{"markers", b.markers},
                 {"samples", b.samples},
                 {"no_slip_error", b.error},
                 {"no_slip_error_m_s", b.error_m_s},
                 {"largest_no_slip_error_m_s", b.largest_error_m_s},
                 {"leakage", b.leakage},
                 {"leakage_m3_s", b.leakage_m3_s},
                 {"marker_speed_m_s", b.marker_speed_m_s},
                 {"reference_speed_m_s", b.reference_speed_m_s}});
}

void ParticipantReport::add(const EnergySummary& e) {
    const auto share = [&](double energy_j) { return energy_j / e.work_j; };
    Json out{{"work_j", e.work_j},
             {"residual_j", e.residual_j},
             {"residual", share(e.residual_j)}};
    if (e.gained_j) {
        out["gained_j"] = *e.gained_j;
        out["gained"] = share(*e.gained_j);
    }
    if (e.layer_j) out["layer_j"] = *e.layer_j;
    add_section(sections, "energy_audit", out);
}

void ParticipantReport::add(const IterationSummary& i) {
    const double steps = i.steps > 0 ? static_cast<double>(i.steps) : 1;
    add_section(sections, "iterations",
                {{"acceleration", i.acceleration},
                 {"measure", i.measure},
                 {"tolerance", i.tolerance},
                 {"mean", static_cast<double>(i.iterations) / steps},
                 {"most", i.most},
                 {"unconverged_steps", i.unconverged},
                 {"mean_residual", i.residual_sum / steps},
                 {"worst_residual", i.worst_residual}});
}

std::string ParticipantReport::to_text() const {
    return Json{fields_of_report(*this), fields(load)}.dump();
}

ParticipantReport ParticipantReport::from_text(const std::string& text) {
    const Json json = Json::parse(text);
    ParticipantReport report;
    read(json.at(0), fields_of_report(report));
    read(json.at(1), fields(report.load));
    return report;
}

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
    for (const char* key : {"versions", "ranks"}) out[key] = Json::object();
    out["steps"] = summary.steps;
    out["substeps"] = 0;
    out["simulated_s"] = summary.simulated_s;
    out["wall_s"] = summary.wall_s;
    for (const char* key : {"tasks", "waiting", "load"}) out[key] = Json::object();
    if (summary.coupling_overhead) out["coupling_overhead"] = *summary.coupling_overhead;
    if (summary.immersed_boundary_share)
        out["immersed_boundary_share"] = *summary.immersed_boundary_share;
    out["advice"] = summary.advice;
    for (const char* key : {"memory_bytes", "processor_s"}) out[key] = Json::object();
    for (const ParticipantReport& side : summary.participants) {
        out["versions"].update(object(side.versions));
        out["ranks"][side.name] = side.load.ranks;
        if (side.substeps > 0) out["substeps"] = side.substeps;
        out["tasks"][side.name] = object(side.tasks);
        out["waiting"][side.name] = object(side.waiting);
        out["load"][side.name] = {{"working_s", side.load.working_s},
                                  {"waiting_s", side.load.waiting_s},
                                  {"imbalance", side.load.imbalance}};
        out["memory_bytes"][side.name] = side.memory_bytes;
        out["processor_s"][side.name] = side.processor_s;
        for (const auto& [key, text] : side.sections) out[key] = Json::parse(text);
    }
    out["probes"] = object(summary.probes);
    out["extra"] = Json::object();
    if (summary.restarted_at_step)
        out["extra"]["restarted_at_step"] = *summary.restarted_at_step;
    return out;
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
    // The cause may quote bytes of a file: what is not UTF-8 is replaced and does not
    // throw.
    const auto text =
        to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace);
    write_atomically(path, text + '\n');
}

void add_record(const std::filesystem::path& path, const RunRecord& record,
                bool goes_on) {
    Json all = Json::array();
    if (std::ifstream in(path); goes_on && in) all = Json::parse(in, nullptr, false);
    if (!all.is_array()) all = Json::array();  // a damaged file must not stop the run
    const auto now =
        std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    all.push_back({{"begun", fmt::format("{:%FT%TZ}", fmt::gmtime(now))},
                   {"command", record.command},
                   {"scene", record.scene},
                   {"overrides", record.overrides},
                   {"restart", record.restart},
                   {"versions", object(record.versions)},
                   {"machine", record.machine},
                   {"ranks", object(record.ranks)}});
    write_atomically(path,
                     all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace magfsi::output
