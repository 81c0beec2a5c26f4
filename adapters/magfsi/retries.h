// SPDX-License-Identifier: GPL-2.0-or-later
// What magfsi run does with checkpoint.on_divergence: retry. All participants of a run
// that diverged have ended; the next job goes on from the last checkpoint (from the start
// while there is none) with half of every step, to the end of the run.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::launch {

class Retries {
  public:
    // restart: as given to the run; one of a run that was halved goes on as halved.
    Retries(const scene::Scene& scene, const std::filesystem::path& out,
            const std::string& restart);

    // Of the coming job: latest, a file, or empty; how often its steps are halved.
    const std::string& restart() const { return restart_; }
    int halvings() const { return scene_.time.halvings; }

    // After a job that diverged: whether there is another, from where and why; else why
    // not. From a checkpoint from which the job came to no other, to the one before it:
    // what grew may have been in it.
    bool again(const std::string& cause);
    const std::string& note() const { return note_; }
    // All notes so far: for a log that begins anew.
    const std::vector<std::string>& notes() const { return notes_; }

    // For the summary; empty without a retry.
    const nlohmann::ordered_json& record() const { return record_; }

  private:
    struct Place {
        std::string restart;  // empty: the start
        double time_s = 0;
    };
    Place newest() const;
    void drop_newest() const;
    double step_s() const;

    scene::Scene scene_;
    std::filesystem::path out_;
    std::string given_, restart_;
    double from_s_ = 0;
    std::string note_;
    std::vector<std::string> notes_;
    nlohmann::ordered_json record_ = nlohmann::ordered_json::array();
};

}  // namespace magfsi::launch
