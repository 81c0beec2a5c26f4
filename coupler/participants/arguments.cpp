#include "coupler/participants/arguments.h"

#include <CLI/CLI.hpp>
#include <map>
#include <stdexcept>

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
    app.add_flag("--record", a.record, "Write exchange.record");
    app.add_option("--replay", a.replay, "The exchange.record that is played");
    app.add_option("--progress", a.progress, "terminal, plain or off")
        ->transform(CLI::CheckedTransformer(modes));
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

std::filesystem::path default_out(const std::string& scene_name) {
    return std::filesystem::path("runs") / scene_name;
}

}  // namespace magfsi::coupler
