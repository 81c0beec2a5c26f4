#include "coupler/checkpoint/restart.h"

#include <fmt/format.h>

#include "coupler/checkpoint/checkpoint_files.h"
#include "coupler/checkpoint/state_reader.h"
#include "coupler/step/clock.h"

namespace magfsi::coupler {

namespace fs = std::filesystem;

namespace {

void check_scene_of(const fs::path& file, const StateHeader& header,
                    const RunPlan& plan) {
    if (header.state_hash == plan.state_hash) return;
    throw std::invalid_argument(fmt::format(
        "--restart: {} is of another scene (hash {:016x}, this one has {:016x}); only "
        "time.end may change: use the scene file and the --set options of that run",
        file.string(), header.state_hash, plan.state_hash));
}

void check_end(const fs::path& file, const StateHeader& header,
               const RunPlan& plan) {
    if (header.step <= Clock(header.step_s, plan.end_s).steps()) return;
    throw std::invalid_argument(fmt::format(
        "--restart: {} is of {:.6g} s, the run ends at {:.6g} s; give a later "
        "time.end, or an earlier checkpoint's file",
        file.string(), static_cast<double>(header.step) * header.step_s,
        plan.end_s));
}

// Throws StateFault on what latest may skip.
StateHeader read_through(const fs::path& folder, std::int64_t step,
                         const RunPlan& plan) {
    StateHeader header;
    for (const Role role : plan.roles) {
        const fs::path file = checkpoint_file(folder, step, role);
        const StateReader reader(file);
        check_scene_of(file, reader.header(), plan);
        check_end(file, reader.header(), plan);
        reader.verify();
        header = reader.header();
        if (header.step != step)
            throw StateFault(fmt::format("{} holds step {}", file.string(), header.step));
    }
    return header;
}

RestartPoint find_latest(const fs::path& folder, const RunPlan& plan) {
    RestartPoint point;
    point.folder = folder;
    for (const std::int64_t step : steps_found(folder)) {
        try {
            point.header = read_through(folder, step, plan);
            return point;
        } catch (const StateFault& fault) {
            point.skipped.emplace_back(fault.what());
        }
    }
    throw std::invalid_argument(
        fmt::format("--restart latest: no complete checkpoint in {}{}{}; start without "
                    "--restart, with the scene key checkpoint",
                    folder.string(), point.skipped.empty() ? "" : ": ",
                    fmt::join(point.skipped, "; ")));
}

RestartPoint find_named(const fs::path& file, const RunPlan& plan) {
    const auto step = step_in_name(file);
    if (!step)
        throw std::invalid_argument(
            fmt::format("--restart: found {}; allowed is latest, or a file "
                        "checkpoint_STEP_structure.h5 or checkpoint_STEP_fluid.h5",
                        file.string()));
    RestartPoint point;
    point.folder = restart_folder(file.string(), {});
    try {
        point.header = read_through(point.folder, *step, plan);
    } catch (const StateFault& fault) {
        throw std::invalid_argument(fmt::format("--restart: {}", fault.what()));
    }
    return point;
}

}  // namespace

fs::path restart_folder(const std::string& wanted, const fs::path& run_folder) {
    if (wanted == "latest") return run_folder;
    const fs::path file(wanted);
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

RestartPoint find_restart(const std::string& wanted, const fs::path& run_folder,
                          const RunPlan& plan) {
    if (!plan.checkpoint)
        throw std::invalid_argument(
            "--restart: the scene has no key checkpoint, so no run of it left one");
    return wanted == "latest" ? find_latest(run_folder, plan)
                              : find_named(wanted, plan);
}

}  // namespace magfsi::coupler
