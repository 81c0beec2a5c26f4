// What each participant reports at the end, and the summary made of it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "coupler/output/probe_file.h"
#include "coupler/output/summary.h"
#include "coupler/participants/session.h"
#include "coupler/step/load_balance.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

struct ParticipantReport {
    std::string name;
    int ranks = 1;
    output::Named<double> tasks;    // seconds on the root rank
    output::Named<double> waiting;  // of them, for the partner
    SideLoad load;
    std::int64_t memory_bytes = 0;  // all ranks
    output::Named<std::string> versions;
    std::optional<output::FluidSummary> fluid;
    std::optional<output::StructureSummary> structure;
    // Known to the structure, which leads: not in the text for the partner.
    std::optional<output::BoundarySummary> immersed_boundary;
    std::optional<output::EnergySummary> energy_audit;
    // Of the side that leads, and so not among what is sent.
    std::optional<output::IterationSummary> iterations;
};

// Name, ranks, tasks, load and memory. idle_s: what this rank's solver has waited for its
// own neighbours, which is no work. Collective over the participant.
ParticipantReport basic_report(const World& world, const TaskList& tasks,
                               double idle_s = 0);

std::string to_text(const ParticipantReport& report);
ParticipantReport report_from_text(const std::string& text);

// probes.csv of this run, or after a restart its goings-on.
std::unique_ptr<output::ProbeFile> open_probes(const Session& session,
                                               const std::vector<std::string>& columns);

// "done: 400 steps in 2.1 s; results in runs/swimmer", or how it was stopped.
std::string end_line(const Session& session, double wall_s);

// summary.json of a run that ended in order; only the lead calls it. probes: the columns
// and the last row of probes.csv, nullptr without one.
void write_summary(const Session& session, std::span<const ParticipantReport> reports,
                   double wall_s, const output::ProbeFile* probes);

}  // namespace magfsi::coupler
