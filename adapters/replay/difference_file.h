// replay.csv: how far the live side is from the one that was recorded, step by step.
#pragma once

#include <span>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/output/probe_file.h"
#include "coupler/participants/session.h"

namespace magfsi::replay {

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
