// SPDX-License-Identifier: GPL-2.0-or-later
// Retries of a run that diverged (checkpoint.on_divergence: retry). When all participants
// have ended, the next job continues from the last checkpoint, or from the start if there
// is none, with half of every time step, to the end of the run.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::launch {

// Decides after each job whether and from where the run is tried again. Lives in the
// launcher, on one process.
class Retries {
  public:
    // `restart` is the command line's option. A run continued from a checkpoint with
    // halved steps keeps them halved. Throws std::invalid_argument if the checkpoint
    // cannot be found. Keeps a reference to solids.
    Retries(const scene::Scene& scene, const bodies::Solids& solids,
            const std::filesystem::path& out, const std::string& restart);

    // Checkpoint of the coming job ("latest", a file, or "" for the start), and the
    // number of times its steps are halved.
    const std::string& restart() const { return restart_; }
    int halvings() const { return scene_.time.halvings; }

    // Must be called after a job that diverged. Returns true if the run is to be tried
    // again, from restart() with halvings(); note() says why or why not. If the last job
    // reached no later checkpoint than the one it started from, that one is deleted and
    // the one before it is taken: it may already hold the growing instability.
    bool again(const std::string& cause);
    const std::string& note() const { return note_; }
    // Notes of all retries so far, for the head of a log that begins anew.
    const std::vector<std::string>& notes() const { return notes_; }

    // Array for summary.json with one object per retry: cause, from_s, coupled_step_s.
    const nlohmann::ordered_json& record() const { return record_; }

  private:
    // A checkpoint to restart from, "" for the start of the run, and its time.
    struct Place {
        std::string restart;  // "" for the start
        double time_s = 0;
    };
    // Newest checkpoint that all participants have written completely.
    Place newest() const;
    // Deletes the newest checkpoint of every participant.
    void drop_newest() const;
    // Coupled step with the present number of halvings [s].
    double step_s() const;

    scene::Scene scene_;
    const bodies::Solids& solids_;
    std::filesystem::path out_;
    // Checkpoint of the command line, and that of the coming job.
    std::string given_, restart_;
    // Time from which the last job started [s].
    double from_s_ = 0;
    std::string note_;
    std::vector<std::string> notes_;
    nlohmann::ordered_json record_ = nlohmann::ordered_json::array();
};

}  // namespace magfsi::launch
