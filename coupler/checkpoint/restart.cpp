// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/checkpoint/restart.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <set>
#include <string>

#include "coupler/step/clock.h"

namespace magfsi::coupler {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = "checkpoint_";

// Calls use(file, step) for each file of a checkpoint, unfinished ones included.
template <class Use>
void each_file(const fs::path& folder, Use&& use) {
    if (!fs::is_directory(folder)) return;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (const auto step = step_in_name(entry.path())) use(entry.path(), *step);
    }
}

// True for a finished file; an unfinished one ends in .tmp.
bool has_its_name(const fs::path& file) {
    return file.extension() == ".h5";
}

}  // namespace

fs::path checkpoint_file(const fs::path& folder, std::int64_t step, Role role) {
    return folder / fmt::format("{}{:010d}_{}.h5", prefix, step, to_string(role));
}

std::optional<std::int64_t> step_in_name(const fs::path& file) {
    const std::string name = file.filename().string();
    if (!name.starts_with(prefix)) return {};
    std::int64_t step = 0;
    const char* const end = name.data() + name.size();
    const auto [at, error] = std::from_chars(name.data() + prefix.size(), end, step);
    if (error != std::errc() || at == end || *at != '_' || step < 0) return {};
    return step;
}

std::vector<std::int64_t> steps_found(const fs::path& folder) {
    std::set<std::int64_t, std::greater<>> steps;
    each_file(folder, [&](const fs::path& file, std::int64_t step) {
        if (has_its_name(file)) steps.insert(step);
    });
    return {steps.begin(), steps.end()};
}

std::vector<std::int64_t> steps_complete(const fs::path& folder,
                                         const std::vector<Role>& roles) {
    std::vector<std::int64_t> steps = steps_found(folder);
    std::erase_if(steps, [&](std::int64_t step) {
        return !std::ranges::all_of(roles, [&](Role role) {
            return fs::exists(checkpoint_file(folder, step, role));
        });
    });
    return steps;
}

void prune_checkpoints(const fs::path& folder, const std::vector<Role>& roles) {
    const auto complete = steps_complete(folder, roles);
    if (complete.size() < checkpoints_kept) return;
    const std::int64_t oldest = complete[checkpoints_kept - 1];
    each_file(folder, [&](const fs::path& file, std::int64_t step) {
        if (step < oldest) fs::remove(file);
    });
}

void clear_checkpoints_after(const fs::path& folder, std::int64_t newest) {
    each_file(folder, [&](const fs::path& file, std::int64_t step) {
        if (step > newest || !has_its_name(file)) fs::remove(file);
    });
}

namespace {

// Throws if the file is of another scene; the hash leaves the end time out.
void check_scene_of(const fs::path& file, const StateHeader& header,
                    const RunPlan& plan) {
    if (header.state_hash == plan.state_hash) return;
    throw std::invalid_argument(fmt::format(
        "--restart: {} is of another scene (hash {:016x}, this one has {:016x}); only "
        "time.end may change: use the scene file and the --set options of that run",
        file.string(), header.state_hash, plan.state_hash));
}

// Throws if the checkpoint is later than the end of the run.
void check_end(const fs::path& file, const StateHeader& header, const RunPlan& plan) {
    if (header.step <= Clock(header.step_s, plan.end_s, plan.steps_at_a_time).steps())
        return;
    throw std::invalid_argument(fmt::format(
        "--restart: {} is of {:.6g} s, the run ends at {:.6g} s; give a later time.end, "
        "or an earlier checkpoint's file",
        file.string(), 1.0 * header.step * header.step_s, plan.end_s));
}

// Reads all files of a checkpoint and verifies their checksums. Throws StateFault for
// damage, which "latest" may pass over, and std::invalid_argument for a wrong scene or
// time, which it may not.
StateHeader read_through(const fs::path& folder, std::int64_t step, const RunPlan& plan) {
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
                    "--restart",
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
        throw std::invalid_argument(fmt::format(
            "--restart: {}; take latest, or the file of another step", fault.what()));
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
            "--restart: the scene has no key checkpoint, so no run of it left one; start "
            "without --restart");
    return wanted == "latest" ? find_latest(run_folder, plan) : find_named(wanted, plan);
}

}  // namespace magfsi::coupler
