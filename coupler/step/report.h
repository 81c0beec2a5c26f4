// SPDX-License-Identifier: GPL-2.0-or-later
// What the log, the progress and summary.json say of a run.
#pragma once

#include <memory>
#include <string>

#include "coupler/immersed_boundary/slip.h"
#include "coupler/output/log.h"
#include "coupler/output/probe_file.h"
#include "coupler/output/summary.h"
#include "coupler/participants/session.h"
#include "coupler/step/load_balance.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

using output::ParticipantReport;

// Name, ranks, tasks, load and memory. idle_s: what this rank's solver has waited for its
// own neighbours, which is no work. Collective over the participant.
ParticipantReport basic_report(const World& world, const TaskList& tasks,
                               double idle_s = 0);

// At the end of a coupled run: the fluid sends its report, the structure receives it.
void send_report(const Session& session, const ParticipantReport& report);
ParticipantReport receive_report(const Session& session);

// probes.csv of this run, continued after a restart.
std::unique_ptr<output::ProbeFile> open_probes(const Session& session,
                                               const std::vector<std::string>& columns);

// "done: 400 steps in 2.1 s; results in runs/swimmer", or how it was stopped.
std::string end_line(const Session& session, double wall_s);

// summary.json of a run that ended in order; only the lead calls it. probes: the columns
// and the last row of probes.csv, nullptr without one.
void write_summary(const Session& session, std::span<const ParticipantReport> reports,
                   double wall_s, const output::ProbeFile* probes);

// How well the immersed boundary held, relative to the larger of the markers' speed (rms)
// and the given flow's; the leakage to that speed times a quarter of the surface, the
// mean cross-section of a convex body.
output::BoundarySummary boundary_summary(const SlipReport& slip, double given_speed_m_s);

std::string to_text(const output::BoundarySummary& boundary);

// For the head of the log: the effects of each step, those that are absent, warnings of
// those that can do nothing.
void log_effects(const Session& session);

// "structure step: ..." and, in a coupled run, what the other side says of itself, which
// calls this, too, before the first exchange. First a line on this side, if not empty.
void log_steps(const Session& session, const TaskList& tasks,
               const std::string& about = "");

// The progress of a participant that leads, on its standard output. After session.begin.
std::unique_ptr<output::Progress> progress_on_stdout(const Session& session,
                                                     output::ProgressMode mode);

}  // namespace magfsi::coupler
