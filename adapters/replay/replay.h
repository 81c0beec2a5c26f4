// SPDX-License-Identifier: GPL-2.0-or-later
// What both players of a recorded run need: the record, and how far the live side is from
// the one that was recorded.
#pragma once

#include <span>

#include "adapters/scene/scene.h"
#include "coupler/exchange/exchange_record.h"
#include "coupler/immersed_boundary/grid.h"
#include "coupler/output/probe_file.h"
#include "coupler/participants/guard.h"
#include "coupler/participants/session.h"

namespace magfsi::replay {

// Throws std::invalid_argument, one line, where the record cannot be played in this run:
// another coupled step, fewer steps, another first step, other fluid probes, more than
// one rank, or an effect that only a real participant has. The scene may differ from the
// recorded one in all else.
coupler::RecordReader open_record(const scene::Scene& scene,
                                  const coupler::ParticipantArguments& arguments,
                                  const coupler::Session& session);

// replay.csv: how far the live side is from the one that was recorded, step by step.
class DifferenceFile {
  public:
    // unit: of what is compared, "m" or "m/s".
    DifferenceFile(const coupler::Session& session, const char* unit);

    // The largest difference over the markers at the end of the step that was completed.
    void add(std::span<const coupler::Vec3> live,
             std::span<const coupler::Vec3> recorded);

    // "the fluid's velocities differ from the recorded by at most 0.1 m/s, first ...".
    void report(const char* what) const;

  private:
    const coupler::Session& session_;
    const char* unit_;
    output::ProbeFile file_;
    double largest_ = 0;
    std::int64_t first_step_ = -1;  // where anything differed
};

}  // namespace magfsi::replay
