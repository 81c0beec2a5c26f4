// SPDX-License-Identifier: GPL-2.0-or-later
// The place of a restart is found among the checkpoints of the run folder;
// coupler/checkpoint/restart.h reads them.
#include "adapters/app/retries.h"

#include <fmt/format.h>

#include <cmath>

#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "adapters/solvers/lammps/substeps.h"
#include "coupler/checkpoint/restart.h"

namespace magfsi::launch {

namespace {

// Time of a checkpoint [s]. Steps of a halved run are counted in its own, shorter steps.
double time_of(const coupler::StateHeader& header) {
    return 1.0 * header.step * header.step_s;
}

bool retry(const scene::Scene& scene) {
    return scene.checkpoint && scene.checkpoint->retry();
}

}  // namespace

// A restart takes the number of halvings from the ratio of the scene's step to the
// checkpoint's.
Retries::Retries(const scene::Scene& scene, const bodies::Solids& solids,
                 const std::filesystem::path& out, const std::string& restart)
    : scene_(scene), solids_(solids), out_(out), given_(restart), restart_(restart) {
    if (!retry(scene) || restart.empty()) return;
    const auto header = coupler::find_restart(restart, out, run_plan(scene, true)).header;
    from_s_ = time_of(header);
    const auto ratio = std::llround(step_s() / header.step_s);
    if (ratio > 1) scene_.time.halvings = std::ilogb(static_cast<double>(ratio));
}

// Coupled step [s] with all halvings so far; of bodies alone it follows from their stable
// step.
double Retries::step_s() const {
    const auto coupled = scene::coupled_step_s(scene_);
    return coupled ? *coupled : lammps::choose_substeps(scene_, solids_).coupled_step_s;
}

// The newest checkpoint of the run folder, else the one that the run was started from,
// else the start.
Retries::Place Retries::newest() const {
    const auto at = [&](const std::string& restart) -> Place {
        return {
            restart,
            time_of(coupler::find_restart(restart, out_, run_plan(scene_, true)).header)};
    };
    try {
        return at("latest");
    } catch (const std::invalid_argument&) {  // no checkpoint yet
        return given_.empty() ? Place{} : at(given_);
    }
}

// Deletes the newest checkpoint of all roles.
void Retries::drop_newest() const {
    const auto roles = run_plan(scene_).roles;
    const auto steps = coupler::steps_complete(out_, roles);
    if (steps.empty()) return;
    for (const coupler::Role role : roles)
        std::filesystem::remove(coupler::checkpoint_file(out_, steps.front(), role));
}

// A new divergence without progress since the last restart means that the newest
// checkpoint already holds the growing instability, so it is deleted.
bool Retries::again(const std::string& cause) {
    if (!retry(scene_)) return false;
    const int done = record_.size();
    const int most = scene_.checkpoint->max_retries;
    const std::string fault =
        done == most ? fmt::format("{} of at most {} retries done", done, most)
                     : scene::fault_of_half_step(scene_);
    if (!fault.empty()) {
        note_ = fmt::format("no retry: {}", fault);
        return false;
    }
    Place place = newest();
    if (done > 0 && place.time_s > 0 && place.time_s <= from_s_) {
        drop_newest();
        place = newest();
    }
    restart_ = place.restart;
    from_s_ = place.time_s;
    ++scene_.time.halvings;
    note_ = fmt::format(
        "retry {} of at most {}: {}; on from t = {:.6g} s with coupled steps of {:.4g} "
        "us",
        done + 1, most, cause, from_s_, step_s() * 1e6);
    notes_.push_back(note_);
    record_.push_back(
        {{"cause", cause}, {"from_s", from_s_}, {"coupled_step_s", step_s()}});
    return true;
}

}  // namespace magfsi::launch
