// SPDX-License-Identifier: GPL-2.0-or-later
// A run in order: read and check the scene, lock the run folder, start the job, retry
// after a divergence if the scene says so, name the end, and complete summary.json.
#include "adapters/app/run.h"
#include "adapters/app/host_name.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "adapters/app/after_run.h"
#include "adapters/app/cost.h"
#include "adapters/app/explain.h"
#include "adapters/app/job.h"
#include "adapters/app/retries.h"
#include "adapters/app/run_again.h"
#include "adapters/app/run_checks.h"
#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "adapters/scene/scene.h"
#include "coupler/checkpoint/restart.h"
#include "coupler/output/file.h"
#include "coupler/output/run_folder.h"
#include "coupler/output/summary.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/guard.h"

namespace magfsi::launch {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

// Path of a program beside this one.
fs::path program(const std::string& name) {
    return fs::read_symlink("/proc/self/exe").parent_path() / name;
}

// Command lines of all participants, the user's program and the controller included.
std::vector<Program> participants(const scene::Scene& scene, const RunOptions& options,
                                  const fs::path& out) {
    std::vector<std::string> arguments{options.scene.string(), "--out", out.string(),
                                       "--progress",
                                       isatty(STDOUT_FILENO) ? "terminal" : "plain"};
    if (!options.restart.empty())
        arguments.insert(arguments.end(), {"--restart", options.restart});
    for (const std::string& o : options.overrides)
        arguments.insert(arguments.end(), {"--set", o});
    for (const std::string& note : options.notes)
        arguments.insert(arguments.end(), {"--note", note});
    if (options.overwrite) arguments.emplace_back("--overwrite");
    if (options.trace) arguments.emplace_back("--trace");
    if (options.halvings > 0)
        arguments.insert(arguments.end(),
                         {"--halvings", std::to_string(options.halvings)});
    std::vector<Program> programs;
    const auto names = programs_of(scene);
    for (const char* role : {"structure", "fluid"}) {
        if (!names.contains(role)) continue;
        Program p{role, options.ranks.at(role), {program(names.at(role)).string()}};
        p.command.insert(p.command.end(), arguments.begin(), arguments.end());
        if (p.role == "structure" && scene.has_own_structure()) {
            p.command.front() = fs::absolute(options.structure).string();
            // The user's program knows no log of magfsi: its name is noted there.
            p.command.insert(p.command.end(),
                             {"--note", fmt::format("{} in place of magfsi-structure",
                                                    options.structure.string())});
        }
        programs.push_back(std::move(p));
    }
    if (scene.control)
        programs.push_back({"controller", 1, {python, "-P", "-m", "magfsi.controller"}});
    return programs;
}

// Not an object if there is no summary or it cannot be parsed.
Json read_summary(const fs::path& out) {
    std::ifstream in(out / "summary.json");
    return Json::parse(in, nullptr, false);  // no object where there is none
}

bool is_complete(const fs::path& out) {
    const Json summary = read_summary(out);
    return summary.is_object() &&
           summary.value("outcome", "") == output::to_text(output::Outcome::completed);
}

void write_summary(const fs::path& out, const Json& summary) {
    output::write_atomically(out / "summary.json", summary.dump(2) + "\n");
}

// Writes the outcome into summary.json in place of participants that could not: survivors
// of a lost process, or processes that were asked to end while they started.
void write_end(const scene::Scene& scene, const fs::path& out, output::Outcome outcome,
               const std::string& cause) {
    Json json = read_summary(out);
    if (!json.is_object()) {
        output::Summary summary;
        summary.scene = scene.name;
        summary.scene_hash = scene.hash;
        summary.effects = scene::active_effects(scene);
        summary.absent_effects = scene::absent_effects(scene);
        json = output::to_json(summary);
    }
    json["outcome"] = output::to_text(outcome);
    json["cause"] = cause;
    write_summary(out, json);
}

// Adds the predicted cost to summary.json and prints it beside the actual figures.
void write_predicted(const fs::path& out, const std::optional<Prediction>& predicted) {
    Json json = read_summary(out);
    if (!predicted || !json.is_object()) return;
    json["predicted"] = to_json(*predicted);
    write_summary(out, json);
    if (!predicted->wall_s) return;
    double bytes = 0;
    for (const auto& side : json.at("memory_bytes")) bytes += side.get<double>();
    fmt::print("predicted {:.3g} s and {:.3g} MB, took {:.3g} s and {:.3g} MB\n",
               *predicted->wall_s,
               (predicted->structure_bytes + predicted->fluid_bytes) / 1e6,
               json.value("wall_s", 0.0), bytes / 1e6);
}

// Locks the run folder before anything is started, so that a refusal costs nothing, and
// moves results of an earlier run aside. The job's processes take the lock over
// (coupler::Session).
void take_run_folder(const fs::path& out, const RunOptions& options,
                     output::FolderLock& lock) {
    const bool free = lock.wait_for_job(output::patience_with_the_ending_s, [] {
        fmt::print(stderr, "waiting for the processes of an earlier run to end\n");
    });
    if (!free)
        throw output::FolderTaken(fmt::format(
            "the run folder {} belongs to a run that goes on: {}; wait for its end, or "
            "take another folder with --out",
            out.string(), lock.owner()));
    lock.sign("magfsi run");
    if (goes_on_in(out, options.restart)) {
        fs::remove(out / "summary.json");
        return;
    }
    const auto& names = scene::names<scene::FluidSolver>;
    const std::vector<std::string> solvers(names.begin(), names.end());
    const fs::path earlier = output::set_aside(out, solvers, options.overwrite);
    if (!earlier.empty())
        fmt::print(
            "the results of an earlier run are now in {} (--overwrite drops them)\n",
            earlier.string());
}

// Open MPI's mpirun sometimes crashes after all its processes have ended (open-mpi/ompi
// #13650). If a summary written since the start of the job says that the run is complete
// or stopped on request, the crash is ignored.
void forgive_a_late_crash(const fs::path& out, fs::file_time_type began, JobEnd& end) {
    std::error_code absent;
    const auto written = fs::last_write_time(out / "summary.json", absent);
    if (!end.crashed || absent || written < began) return;
    const Json summary = read_summary(out);
    const std::string outcome =
        summary.is_object() ? summary.value("outcome", "") : std::string{};
    const bool stopped =
        end.stopped && outcome == output::to_text(output::Outcome::stopped);
    if (!stopped && outcome != output::to_text(output::Outcome::completed)) return;
    fmt::print(stderr,
               "magfsi: mpirun crashed when the run had ended; nothing of it is lost\n");
    end.lost.clear();
    end.exit_code = coupler::exit_done;
}

JobEnd run_once(const scene::Scene& scene, const RunOptions& options, const fs::path& out,
                output::FolderLock& lock) {
    const auto programs = participants(scene, options, out);
    take_run_folder(out, options, lock);
    fmt::print("{}\n", fmt::join(mpirun_command(programs), " "));
    std::fflush(stdout);
    const auto began = fs::file_time_type::clock::now();
    JobEnd end = run_job(programs, scene.checkpoint ? OnStop::checkpoint : OnStop::end);
    // No process of the job may be left when this process ends, whatever became of
    // mpirun.
    if (!lock.wait_for_job(output::patience_with_the_ending_s))
        fmt::print(stderr, "magfsi: processes of the run are still there: {}\n",
                   lock.owner());
    forgive_a_late_crash(out, began, end);
    return end;
}

JobEnd run_with_retries(const scene::Scene& scene, RunOptions options,
                        const fs::path& out, Retries& retries, output::FolderLock& lock) {
    const std::vector<std::string> head = options.notes;
    while (true) {
        options.restart = retries.restart();
        options.halvings = retries.halvings();
        JobEnd end = run_once(scene, options, out, lock);
        const bool diverged =
            end.exit_code == coupler::exit_diverged && end.lost.empty() && !end.stopped;
        Json summary = read_summary(out);
        const std::string cause = summary.is_object() ? summary.value("cause", "") : "";
        if (!diverged || !retries.again(cause)) {
            if (!retries.record().empty() && summary.is_object()) {
                summary["retries"] = retries.record();
                write_summary(out, summary);
            }
            if (diverged && !retries.note().empty())
                fmt::print(stderr, "magfsi: {}\n", retries.note());
            return end;
        }
        fmt::print("{}\n", retries.note());
        options.overwrite = true;  // results in the folder are this run's own
        // A log that is continued already has the earlier notes.
        options.notes = {retries.note()};
        if (!retries.restart().empty()) continue;
        options.notes = head;
        options.notes.insert(options.notes.end(), retries.notes().begin(),
                             retries.notes().end());
    }
}

// Maps the exit code of a job: one outside the table of coupler/participants/errors.h has
// a cause outside the participants.
int unnamed_end(const JobEnd& end) {
    if (!end.told)
        fmt::print(stderr,
                   "magfsi: the MPI job ended with code {} before its programs could say "
                   "why; what mpirun said is above\n",
                   end.exit_code);
    return end.exit_code > coupler::exit_partner ? coupler::exit_error : end.exit_code;
}

// Reports how the run ended, completes summary.json, and returns the exit code of the
// command line.
int conclude(const scene::Scene& scene, const bodies::Solids& solids,
             const RunOptions& options, const fs::path& out, const JobEnd& end,
             bool without_retries) {
    if (!end.lost.empty()) {
        fmt::print(stderr, "magfsi: lost a partner: {}\n", end.lost);
        write_end(scene, out, output::Outcome::lost_partner, end.lost);
        return coupler::exit_partner;
    }
    // A request to end may arrive after the last step.
    const bool came_late = end.exit_code == coupler::exit_done && is_complete(out);
    if (end.stopped && !came_late) {
        if (!read_summary(out).is_object())
            write_end(scene, out, output::Outcome::stopped,
                      "asked to end before the participants could say how far they were");
        const bool goes_on = !coupler::steps_complete(out, run_plan(scene).roles).empty();
        fmt::print(stderr, "magfsi: stopped on request; results so far are in {}{}\n",
                   out.string(), goes_on ? "; go on with --restart latest" : "");
        return coupler::exit_error;
    }
    if (end.exit_code != coupler::exit_done) return unnamed_end(end);
    if (!read_summary(out).is_object()) {
        fmt::print(
            stderr,
            "magfsi: mpirun ended with code 0, but nothing was run: there is no {}; "
            "./magfsi doctor looks at this machine's mpirun\n",
            (out / "summary.json").string());
        return coupler::exit_error;
    }
    // The prediction holds for whole runs without retries.
    if (options.restart.empty() && without_retries)
        write_predicted(out, prediction(scene, solids, options.ranks));
    return coupler::exit_done;
}

// Replaces this process by the Python package, which searches for the cheapest setting
// within the tolerance and then calls this program without one. Never returns; throws if
// that cannot be done.
void run_within_tolerance(const scene::Scene& scene, const RunOptions& options) {
    if (!options.restart.empty()) {
        throw std::invalid_argument(
            "--error: found with --restart, which belongs to one setting; run that "
            "without a tolerance");
    }
    if (!std::getenv("PYTHONPATH")) {
        throw std::invalid_argument(
            "--error: needs the launcher ./magfsi, which knows the Python package");
    }
    std::vector<std::string> words{python, "-P", "-m", "magfsi.cost.within",
                                   options.scene.string()};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) words.insert(words.end(), {option, value});
    };
    if (!options.error.empty())
        add("--error", options.error);
    else
        add("--error", fmt::format("{} %", 100 * scene.accuracy->error));
    add("--out", options.out.string());
    for (const std::string& o : options.overrides) add("--set", o);
    if (!options.ranks.empty()) add("--ranks", to_text(options.ranks));
    if (options.overwrite) words.emplace_back("--overwrite");
    if (scene.accuracy) {
        for (const std::string& probe : scene.accuracy->probes) add("--probe", probe);
        add("--norm", std::string(scene::name_of(scene.accuracy->norm)));
        add("--budget", fmt::format("{} s", scene.accuracy->budget_s));
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments.front(), arguments.data());
    throw std::runtime_error(
        fmt::format("--error: {} cannot be started: {}; install Python (Debian: apt-get "
                    "install python3)",
                    words.front(), std::strerror(errno)));
}

}  // namespace

int run(RunOptions options) {
    const scene::Scene scene = scene::read_scene(options.scene, options.overrides);
    if (scene.accuracy || !options.error.empty()) run_within_tolerance(scene, options);
    if (scene.fluid) {
        const std::string fault = fluid_program(scene).missing();
        if (!fault.empty())
            throw std::invalid_argument(fmt::format(
                "fluid.solver: {}: {}", scene::name_of(scene.fluid->solver), fault));
    }
    const auto solids = bodies::to_bodies(scene);
    check_memory(scene, solids);
    check_structure_program(scene, options);
    if (options.ranks.empty()) options.ranks = ranks_of_run(scene, options.scene);
    options.ranks = choose_ranks(scene, solids, options.ranks);
    // explain() builds obstacles, markers and steps, so that a scene that cannot run is
    // refused as bad input before anything is written or started.
    const auto warned = warnings(explain(scene, solids, options.ranks));
    const fs::path out = run_folder(scene, options);
    if (!options.restart.empty())
        (void)coupler::find_restart(options.restart, out, run_plan(scene, true));
    if (scene.control) need_controller();
    need_stack();
    pass_on_signals();
    // Before there is a second thread, which may read the environment.
    set_mpirun_environment();
    setenv("MAGFSI_COMMAND", options.command.c_str(), 1);  // for run.json
    warn_of_host_name();
    fs::create_directories(out);
    output::FolderLock lock(out, output::FolderLock::Holder::launcher, 0);
    if (!lock.held())
        fmt::print(stderr,
                   "warning: the file system of {} has no locks; see that no other "
                   "run uses it\n",
                   out.string());
    for (const std::string& line : warned) fmt::print(stderr, "warning: {}\n", line);
    Retries retries(scene, solids, out, options.restart);
    const JobEnd end = run_with_retries(scene, options, out, retries, lock);
    if (options.trace) merge_traces(out);
    const int code = conclude(scene, solids, options, out, end, retries.record().empty());
    if (options.page && read_summary(out).is_object()) start_page(scene, out);
    return code;
}

}  // namespace magfsi::launch
