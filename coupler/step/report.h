// SPDX-License-Identifier: GPL-2.0-or-later
// The texts and numbers of a run in the log, the progress and summary.json.
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

// Name, ranks, tasks, load and memory of a participant. idle_s: time [s] that this rank's
// solver has waited for its own neighbours, which does not count as work. Collective over
// the participant; the result is complete on its root.
ParticipantReport basic_report(const World& world, const TaskList& tasks,
                               double idle_s = 0);

// Final report of the fluid to the structure in a coupled run: the fluid sends it, the
// structure receives it. Collective over both sides.
void send_report(const Session& session, const ParticipantReport& report);
ParticipantReport receive_report(const Session& session);

// Opens probes.csv of this run; after a restart continues the file. Leading process only.
std::unique_ptr<output::ProbeFile> open_probes(const Session& session,
                                               const std::vector<std::string>& columns);

// The last line of the log: "done: 400 steps in 2.1 s; results in runs/swimmer", or the
// cause of a stop.
std::string end_line(const Session& session, double wall_s);

// Writes summary.json of a run that ended in order; leading process only. reports: of one
// or both participants, the structure first. probes: source of the last values; null
// without probes.csv.
void write_summary(const Session& session, std::span<const ParticipantReport> reports,
                   double wall_s, const output::ProbeFile* probes);

// Slip relative to the reference speed, the larger of the markers' rms speed and the
// speed given by inlets, walls and initial flow [m/s]; leakage relative to that speed
// times a quarter of the surface, which is the mean cross-section of a convex body.
output::BoundarySummary boundary_summary(const SlipReport& slip, double given_speed_m_s);

// A line for the log, with a warning above 5 %. can_hold: the run could have forcing
// no_slip, and has not.
std::string to_text(const output::BoundarySummary& boundary, bool can_hold);

// Logs the effects of each part of the step, present and absent, and warnings about
// effects that can do nothing.
void log_effects(const Session& session);

// Logs the list of tasks, "structure step: ...", and in a coupled run that of the other
// side, which must make the same call before the first exchange. about: a first line
// about this side, unless empty.
void log_steps(const Session& session, const TaskList& tasks,
               const std::string& about = "");

// The progress of a leading participant on its standard output. Must be made after
// session.begin.
std::unique_ptr<output::Progress> progress_on_stdout(const Session& session,
                                                     output::ProgressMode mode);

}  // namespace magfsi::coupler
