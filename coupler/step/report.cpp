// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/step/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>

#include "coupler/participants/handshake.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

namespace {

// The largest resident memory that this process ever had (VmHWM) [bytes]; 0 if the kernel
// does not say.
std::int64_t peak_resident_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string key; status >> key; std::getline(status, key)) {
        std::int64_t kibibytes = 0;
        if (key == "VmHWM:" && status >> kibibytes) return 1024 * kibibytes;
    }
    return 0;
}

// What all threads of this process have taken of the processors since it began [s].
double processor_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Sums the tasks by kind and reduces them over the ranks. Collective.
SideLoad load_of(const World& world, const std::vector<TaskTime>& tasks, double idle_s) {
    enum { working, waiting, solver, output, steps, values };
    std::array<double, values> mine{};
    double immersed_boundary_s = 0;
    for (const TaskTime& task : tasks) {
        const double work_s = task.seconds - task.waiting_s;
        mine[working] += work_s;
        mine[waiting] += task.waiting_s;
        mine[steps] += task.seconds;
        if (task.kind == TaskKind::solver) mine[solver] += work_s;
        if (task.kind == TaskKind::immersed_boundary) immersed_boundary_s += work_s;
        if (task.kind == TaskKind::output) mine[output] += work_s;
    }
    mine[working] -= idle_s;
    std::array<double, 2> most_s{mine[working], immersed_boundary_s};
    // Inside the solver ranks wait for the one that still samples and spreads; that one
    // waits least, so that the smallest solver time is the true one.
    double least_solver_s = mine[solver];
    std::array<double, values> all = mine;
    MPI_Allreduce(MPI_IN_PLACE, all.data(), values, MPI_DOUBLE, MPI_SUM, world.local());
    MPI_Allreduce(MPI_IN_PLACE, most_s.data(), 2, MPI_DOUBLE, MPI_MAX, world.local());
    MPI_Allreduce(MPI_IN_PLACE, &least_solver_s, 1, MPI_DOUBLE, MPI_MIN, world.local());
    for (double& value : all) value /= world.size();
    SideLoad load{world.size(),   all[working], all[waiting],
                  least_solver_s, most_s[1],    all[output]};
    load.steps_s = all[steps];
    if (all[working] > 0) load.imbalance = most_s[0] / all[working];
    return load;
}

// Adds the entries that compare two sides; a run without a partner has none of them.
void add_balance(const Session& session, output::Summary& summary,
                 const ParticipantReport& structure, const ParticipantReport& fluid) {
    summary.coupling_overhead = coupling_overhead(structure.load, fluid.load);
    summary.immersed_boundary_share = immersed_boundary_share(structure.load, fluid.load);
    const int cores = sysconf(_SC_NPROCESSORS_ONLN);
    const auto better = advice(structure.load, fluid.load, summary.wall_s, cores);
    if (!better) return;
    summary.advice = *better;
    session.log(*better);
}

}  // namespace

ParticipantReport basic_report(const World& world, const TaskList& tasks, double idle_s) {
    ParticipantReport report;
    report.name = to_string(world.self());
    report.versions = versions();
    const std::vector<TaskTime> times = tasks.times();
    for (const TaskTime& task : times) {
        report.tasks.emplace_back(task.name, task.seconds);
        if (task.waiting_s > 0) report.waiting.emplace_back(task.name, task.waiting_s);
    }
    report.load = load_of(world, times, idle_s);
    const std::int64_t mine = peak_resident_bytes();
    MPI_Reduce(&mine, &report.memory_bytes, 1, MPI_INT64_T, MPI_SUM, 0, world.local());
    const double taken_s = processor_s();
    MPI_Reduce(&taken_s, &report.processor_s, 1, MPI_DOUBLE, MPI_SUM, 0, world.local());
    return report;
}

void send_report(const Session& session, const ParticipantReport& report) {
    swap_text(session.world(), report.to_text(), session.timeout_s(), "final report");
}

ParticipantReport receive_report(const Session& session) {
    return ParticipantReport::from_text(
        swap_text(session.world(), "", session.timeout_s(), "final report"));
}

std::unique_ptr<output::ProbeFile> open_probes(const Session& session,
                                               const std::vector<std::string>& columns) {
    const auto file = session.out() / "probes.csv";
    if (!session.restart()) return std::make_unique<output::ProbeFile>(file, columns);
    return std::make_unique<output::ProbeFile>(file, columns, session.clock().time_s());
}

std::string end_line(const Session& session, double wall_s) {
    if (session.stop_cause())
        return fmt::format("stopped: {}; go on with --restart latest",
                           *session.stop_cause());
    return fmt::format("done: {} steps in {:.1f} s; results in {}",
                       session.clock().steps_here(), wall_s, session.out().string());
}

void write_summary(const Session& session, std::span<const ParticipantReport> reports,
                   double wall_s, const output::ProbeFile* probes) {
    output::Summary summary = summary_of(session.state());
    summary.outcome = output::Outcome::completed;
    if (session.stop_cause()) {
        summary.outcome = output::Outcome::stopped;
        summary.cause = *session.stop_cause();
    }
    if (session.restart()) summary.restarted_at_step = session.clock().first_step();
    summary.wall_s = wall_s;
    if (probes) {
        const auto last = probes->last_row();
        for (std::size_t i = 0; i < last.size(); ++i)
            summary.probes.emplace_back(probes->columns()[i], last[i]);
    }
    summary.participants.assign(reports.begin(), reports.end());
    if (reports.size() == 2) add_balance(session, summary, reports[0], reports[1]);
    output::write_summary(session.out() / "summary.json", summary);
}

output::BoundarySummary boundary_summary(const SlipReport& slip, double given_speed_m_s) {
    output::BoundarySummary b;
    b.markers = slip.markers;
    b.samples = slip.samples;
    b.error_m_s = slip.error_m_s;
    b.largest_error_m_s = slip.largest_error_m_s;
    b.marker_speed_m_s = slip.marker_speed_m_s;
    b.leakage_m3_s = slip.leakage_m3_s;
    b.reference_speed_m_s = std::max(slip.marker_speed_m_s, given_speed_m_s);
    if (b.reference_speed_m_s > 0) {
        b.error = b.error_m_s / b.reference_speed_m_s;
        if (slip.surface_m2 > 0)
            b.leakage = b.leakage_m3_s / (b.reference_speed_m_s * 0.25 * slip.surface_m2);
    }
    return b;
}

std::string to_text(const output::BoundarySummary& b, bool can_hold) {
    constexpr double warned_above = 0.05;
    std::string text = fmt::format(
        "immersed boundary: no-slip error {:.2g} %, leakage {:.2g} % of {:.3g} m/s ({} "
        "markers, {} samples)",
        100 * b.error, 100 * b.leakage, b.reference_speed_m_s, b.markers, b.samples);
    if (std::max(b.error, b.leakage) > warned_above)
        text += fmt::format(
            "; warning: above 5 % the forces on bodies depend on the coupled step: {}"
            "compare with a run of half the time.step",
            can_hold ? "take coupling.immersed_boundary.forcing: no_slip, or " : "");
    return text;
}

void log_effects(const Session& session) {
    for (const std::string& line : session.plan().effects_by_step)
        session.log("effects of the " + line);
    for (const std::string& line : session.plan().warnings)
        session.log("warning: " + line);
}

void log_steps(const Session& session, const TaskList& tasks, const std::string& about) {
    std::string text = to_string(session.world().self()) + " step: " + tasks.names();
    if (!about.empty()) text.insert(0, about + "\n");
    if (session.world().coupled()) {
        const std::string other =
            swap_text(session.world(), text, session.timeout_s(), "list of its tasks");
        text += "\n" + other;
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) session.log(line);
}

std::unique_ptr<output::Progress> progress_on_stdout(const Session& session,
                                                     output::ProgressMode mode) {
    const char* const end = mode == output::ProgressMode::plain ? "\n" : "";
    return std::make_unique<output::Progress>(
        mode,
        output::ProgressGoal{session.clock().steps(), session.plan().end_s,
                             session.clock().first_step()},
        [end](std::string_view text) {
            fmt::print("{}{}", text, end);
            std::fflush(stdout);
        });
}

}  // namespace magfsi::coupler
