// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi: the program behind the launcher.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "adapters/app/cost.h"
#include "adapters/app/doctor.h"
#include "adapters/app/explain.h"
#include "adapters/app/lattice.h"
#include "adapters/app/run.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/fault.h"
#include "adapters/scene/reader.h"
#include "adapters/scene/scene.h"
#include "adapters/scene/schema.h"
#include "coupler/participants/errors.h"

namespace {

using namespace magfsi;

// Values of the command line, in text where they need more than CLI11's checks.
struct Options {
    launch::RunOptions run;
    launch::LatticeOptions lattice;
    std::string ranks, fluid;
    bool json = false;
};

// Options that all commands with a scene share.
void add_scene_options(CLI::App& command, Options& options) {
    command.add_option("scene", options.run.scene, "Scene file or tutorial folder")
        ->required();
    command
        .add_option("--set", options.run.overrides,
                    "Override a value: path.to.key=value, e.g. fluid.spacing='0.1 mm'")
        ->allow_extra_args(false);
    command.add_option("--fluid", options.fluid,
                       fmt::format("Fluid solver: {}",
                                   fmt::join(scene::names<scene::FluidSolver>, " or ")));
}

// Option of the commands whose result depends on the ranks.
void add_ranks(CLI::App& command, Options& options) {
    command.add_option("--ranks", options.ranks, "MPI ranks: structure=N,fluid=M");
}

// Quotes the text where necessary so that a shell takes it as one word.
// The command is kept for run.json, from where it can be pasted into a shell.
std::string word(const std::string& text) {
    constexpr auto plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=,:+-@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

// Explaining the scene builds meshes and solver settings, and so finds faults that
// reading cannot.
int check(const Options& options) {
    const auto scene = scene::read_scene(options.run.scene, options.run.overrides);
    const auto solids = bodies::to_bodies(scene);
    const std::string explained = launch::explain(scene, solids);
    for (const std::string& line : launch::surfaces(explained)) fmt::print("{}\n", line);
    for (const std::string& line : launch::warnings(explained))
        fmt::print("warning: {}\n", line);
    fmt::print("{}: good\n", scene::scene_file(options.run.scene).string());
    return coupler::exit_done;
}

// Text and facts are both computed, so that faults show the same with and without --json.
int explain(const Options& options) {
    const auto scene = scene::read_scene(options.run.scene, options.run.overrides);
    const auto solids = bodies::to_bodies(scene);
    const auto ranks = launch::choose_ranks(scene, solids, options.run.ranks);
    const std::string text = launch::explain(scene, solids, ranks);
    const auto facts = launch::facts(scene, solids, ranks, text);
    if (options.json)
        fmt::print("{}\n", facts.dump(2));
    else
        fmt::print("{}{}", text, launch::explain_cost(scene, solids, ranks));
    return coupler::exit_done;
}

// --fluid is an override of the scene's key fluid.solver.
int execute(CLI::App& app, Options& options) {
    if (!options.fluid.empty()) {
        options.run.overrides.push_back("fluid.solver=" + options.fluid);
    }
    options.run.ranks = launch::parse_ranks(options.ranks);
    const std::string command = app.get_subcommands().front()->get_name();
    if (command == "schema") {
        fmt::print("{}\n", scene::scene_schema().dump(2));
        return coupler::exit_done;
    }
    if (command == "lattice") return launch::lattice(options.lattice);
    if (command == "doctor") return launch::doctor();
    if (command == "check") return check(options);
    if (command == "explain") return explain(options);
    return launch::run(options.run);
}

}  // namespace

// Exit codes are those of coupler/participants/errors.h: faults of the input are
// exit_input, all others exit_error. User text in messages is made safe for the terminal.
int main(int argc, char** argv) {
    CLI::App app{"Hard-magnetic soft robots in a fluid", "magfsi"};
    app.require_subcommand(1);
    app.footer("The launcher has more commands: ./magfsi --help.");
    Options options;
    CLI::App& run = *app.add_subcommand("run", "Run a scene");
    add_scene_options(run, options);
    run.add_option("--out", options.run.out, "Run folder (default: runs/NAME)");
    add_ranks(run, options);
    run.add_option("--restart", options.run.restart,
                   "Go on from a checkpoint: latest, or one of its files");
    run.add_flag("--overwrite", options.run.overwrite,
                 "Drop the results of an earlier run in the folder; without it they are "
                 "moved to earlier-1 in it");
    run.add_flag("--trace", options.run.trace,
                 "Write trace.json: when each task of each rank began and ended, for "
                 "ui.perfetto.dev");
    run.add_flag("!--no-report", options.run.page,
                 "Write no report.html when the run has ended");
    run.add_option("--structure", options.run.structure,
                   "Your own program as the structure (coupling.structure: own)");
    run.add_option(
        "--error", options.run.error,
        "Run the cheapest setting within this tolerance, such as '3 %', found by "
        "magfsi cost; accuracy: {error: 3 %} in the scene does the same");
    add_scene_options(*app.add_subcommand("check", "Check a scene and run nothing"),
                      options);
    CLI::App& explain = *app.add_subcommand(
        "explain", "Effects, steps, lattice values and memory of a scene");
    add_scene_options(explain, options);
    add_ranks(explain, options);
    explain.add_flag("--json", options.json, "Key figures for programs");
    CLI::App& lattice = *app.add_subcommand(
        "lattice", "Bodies of a scene as files for LAMMPS scripts, and back");
    lattice
        .add_option("input", options.lattice.input,
                    "A scene, or NAME.lattice, which becomes NAME.msh and NAME.csv")
        ->required();
    lattice.add_option("--out", options.lattice.out, "Folder (default: the present one)");
    lattice
        .add_option("--set", options.lattice.overrides, "Override a value of the scene")
        ->allow_extra_args(false);
    app.add_subcommand("doctor",
                       "Check this machine: MPI, memory, disk, locks, OpenFOAM");
    app.add_subcommand("schema", "JSON Schema of the scene file");
    for (int i = 0; i < argc; ++i)
        options.run.command += (i > 0 ? " " : "") + word(argv[i]);
    try {
        app.parse(argc, argv);
        return execute(app, options);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? coupler::exit_done : coupler::exit_input;
    } catch (const scene::SceneError& error) {
        fmt::print(stderr, "{}\n", scene::printable(error.what()));
        return coupler::exit_input;
    } catch (const std::invalid_argument& error) {
        fmt::print(stderr, "magfsi: {}\n", scene::printable(error.what()));
        return coupler::exit_input;
    } catch (const std::exception& error) {
        fmt::print(stderr, "magfsi: {}\n", scene::printable(error.what()));
        return coupler::exit_error;
    }
}
