// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/guard.h"

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cfenv>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>

#include "base/process/keep_libraries.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/processes.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

ParticipantArguments parse_arguments(int argc, char** argv,
                                     const std::string& description) {
    ParticipantArguments a;
    CLI::App app{description};
    const std::map<std::string, output::ProgressMode> modes{
        {"terminal", output::ProgressMode::terminal},
        {"plain", output::ProgressMode::plain},
        {"off", output::ProgressMode::off}};
    app.add_option("scene", a.scene, "Scene file, or a folder with a scene.yaml")
        ->required();
    app.add_option("--out", a.out, "Run folder (default: runs/NAME)");
    app.add_option("--set", a.overrides, "Override: path.to.key=value; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--note", a.notes, "A line for the head of the log; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--restart", a.restart,
                   "Go on from a checkpoint: latest, or its file");
    app.add_option("--halvings", a.halvings, "How often every step is halved")
        ->check(CLI::Range(0, 16));
    app.add_flag("--overwrite", a.overwrite,
                 "Drop what an earlier run left in the run folder");
    app.add_flag("--trace", a.trace,
                 "Write when each task began and ended: trace_SIDE_RANK.json");
    app.add_option("--progress", a.progress, "terminal, plain or off")
        ->transform(CLI::CheckedTransformer(modes));
    if (const char* command = std::getenv("MAGFSI_COMMAND")) a.command = command;
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        a.help = true;
        a.help_text = app.help();
    } catch (const CLI::ParseError& error) {
        throw std::invalid_argument(error.what());
    }
    return a;
}

output::Summary summary_of(const RunState& state) {
    output::Summary summary;
    summary.scene = state.plan.name;
    summary.scene_hash = state.plan.scene_hash;
    summary.effects = state.plan.effects;
    summary.absent_effects = state.plan.absent_effects;
    summary.steps = state.step;
    summary.simulated_s = state.time_s;
    return summary;
}

std::filesystem::path default_out(const std::string& scene_name) {
    return std::filesystem::path("runs") / scene_name;
}

namespace {

// Makes invalid operations, divisions by zero and overflows end the process where they
// happen (SIGFPE), on this thread and all threads it starts later. Only in builds with
// MAGFSI_TRAPS.
void trap_floating_point_faults() {
#ifdef MAGFSI_TRAPS
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
}

// Exit code, outcome and cause of a failed run.
struct Ending {
    int code;
    output::Outcome outcome;
    std::string cause;
};

// The ending that belongs to an exception.
Ending classify(const std::exception_ptr& exception) {
    using output::Outcome;
    try {
        std::rethrow_exception(exception);
    } catch (const Diverged& e) {
        return {exit_diverged, Outcome::diverged, e.what()};
    } catch (const PartnerLost& e) {
        return {exit_partner, Outcome::lost_partner, e.what()};
    } catch (const Stopped& e) {
        return {exit_partner, Outcome::stopped, e.what()};
    } catch (const std::invalid_argument& e) {  // bad scene, mesh or solver input
        return {exit_input, Outcome::stopped, e.what()};
    } catch (const std::exception& e) {
        return {exit_error, Outcome::stopped, e.what()};
    }
}

// Writes summary.json for a failed run, unless the folder is not this run's.
void write_failure(const RunState& state, const Ending& ending) {
    if (!state.started) return;
    // A process that is told to end because another one failed leaves the summary to that
    // one, which knows the cause.
    const bool told = ending.outcome == output::Outcome::stopped;
    if (told && std::filesystem::exists(state.out / "summary.json")) return;
    output::Summary summary = summary_of(state);
    summary.outcome = ending.outcome;
    summary.cause = ending.cause;
    try {
        // Both sides may end at the same moment: each writes a file of its own and
        // renames it.
        const auto mine = state.out / fmt::format("summary.{}.json", ::getpid());
        output::write_summary(mine, summary);
        std::filesystem::rename(mine, state.out / "summary.json");
    } catch (const std::exception& e) {
        fmt::print(stderr, "magfsi: {}\n", e.what());
    }
}

}  // namespace

int run_participant(Role role, const std::string& description, int argc, char** argv,
                    const ParticipantBody& body) {
    die_with_mpirun();
    ParticipantArguments arguments;
    try {
        arguments = parse_arguments(argc, argv, description);
    } catch (const std::exception& e) {
        fmt::print(stderr, "magfsi {}: {} (see --help)\n", to_string(role), e.what());
        let_the_others_connect();
        return exit_input;
    }
    if (arguments.help) {
        fmt::print("{}", arguments.help_text);
        return exit_done;
    }
    // Faults of the job are found first, because MPI_Init waits for all of its processes.
    if (const std::string fault = fault_of_job(); !fault.empty()) {
        fmt::print(stderr, "magfsi {}: {}\n", to_string(role), fault);
        let_the_others_connect();
        return exit_partner;
    }
    watch_joining();
    MPI_Init(&argc, &argv);
    if (const std::string fault = fault_of_start(); !fault.empty()) {
        fmt::print(stderr, "magfsi {}: {}\n", to_string(role), fault);
        MPI_Finalize();
        return exit_partner;
    }
    catch_stop_signals();
    trap_floating_point_faults();  // MPI's own start may raise faults
    RunState state;
    try {
        body(arguments, state);
    } catch (...) {
        const Ending ending = classify(std::current_exception());
        write_failure(state, ending);
        const std::string where =
            state.started && state.step > 0
                ? fmt::format(" (after coupled step {}, t = {:.6g} s)", state.step,
                              state.time_s)
                : "";
        fmt::print(stderr, "magfsi {}: {}{}\n", to_string(role), ending.cause, where);
        std::fflush(nullptr);
        MPI_Abort(MPI_COMM_WORLD, ending.code);
    }
    keep_libraries();
    MPI_Finalize();
    return exit_done;
}

}  // namespace magfsi::coupler
