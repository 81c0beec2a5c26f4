#include "adapters/replay/difference_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace magfsi::replay {

DifferenceFile::DifferenceFile(const coupler::Session& session, const char* unit)
    : session_(session),
      unit_(unit),
      file_(session.out() / "replay.csv", {fmt::format("max_difference[{}]", unit)}) {}

void DifferenceFile::add(std::span<const coupler::Vec3> live,
                         std::span<const coupler::Vec3> recorded) {
    double worst = 0;
    for (std::size_t m = 0; m < live.size(); ++m) {
        worst = std::max(
            worst, std::hypot(live[m][0] - recorded[m][0], live[m][1] - recorded[m][1],
                              live[m][2] - recorded[m][2]));
    }
    file_.row(session_.clock().time_s(), {&worst, 1});
    largest_ = std::max(largest_, worst);
    if (worst > 0 && first_step_ < 0) first_step_ = session_.clock().step();
}

void DifferenceFile::report(const char* what) const {
    if (first_step_ < 0) {
        fmt::print("replay: {} are the recorded ones, to the last bit\n", what);
    } else {
        fmt::print(
            "replay: {} differ from the recorded ones by at most {:.4g} {}, first "
            "after step {}; see {}\n",
            what, largest_, unit_, first_step_, (session_.out() / "replay.csv").string());
    }
    std::fflush(stdout);
}

}  // namespace magfsi::replay
