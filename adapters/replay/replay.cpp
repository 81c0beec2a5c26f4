// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "adapters/fluids/fluid_probes.h"

namespace magfsi::replay {

namespace {

using coupler::RecordHeader;

void check_scene(const scene::Scene& scene) {
    if (scene.coupling && scene.coupling->scheme == coupler::Scheme::implicit) {
        throw std::invalid_argument(
            "--replay: a record has one exchange per step, the implicit scheme many; add "
            "--set coupling.scheme=serial --set coupling.iteration=");
    }
    if (scene.checkpoint) {
        throw std::invalid_argument(
            "--replay: a record has no state to keep; add --set checkpoint=");
    }
    if (scene.probes && scene.probes->interface_balance) {
        throw std::invalid_argument(
            "--replay: a record cannot audit the interface; add --set "
            "probes.interface_balance=");
    }
}

void check_steps(const RecordHeader& header, std::int64_t entries,
                 const coupler::Clock& clock) {
    if (header.step_s != clock.step_s()) {
        throw std::invalid_argument(fmt::format(
            "--replay: the record has coupled steps of {:.17g} s, this run of "
            "{:.17g} s; set time.step to the former",
            header.step_s, clock.step_s()));
    }
    if (header.first_step != clock.first_step()) {
        throw std::invalid_argument(
            fmt::format("--replay: the record starts at step {}, this run at step {}",
                        header.first_step, clock.first_step()));
    }
    if (entries - 1 < clock.steps() - clock.first_step()) {
        throw std::invalid_argument(fmt::format(
            "--replay: the record ends after {} coupled steps, this run "
            "takes {}; add --set time.end='{:.9g} s'",
            entries - 1, clock.steps() - clock.first_step(),
            static_cast<double>(entries - 1 + clock.first_step()) * clock.step_s()));
    }
}

}  // namespace

coupler::RecordReader open_record(const scene::Scene& scene,
                                  const coupler::ParticipantArguments& arguments,
                                  const coupler::Session& session) {
    check_scene(scene);
    if (session.world().size() != 1)
        throw std::invalid_argument("--replay: a record is played by one rank");
    coupler::RecordReader record(arguments.replay);
    const RecordHeader& header = record.header();
    if (!scene.coupling)
        throw std::invalid_argument("--replay: the scene has no body in a fluid");
    const auto forcing = scene.coupling->immersed_boundary.forcing;
    if (forcing != header.forcing) {
        throw std::invalid_argument(fmt::format(
            "--replay: the record is of forcing: {0}, this run of {1}; add --set "
            "coupling.immersed_boundary.forcing={0}",
            name_of(header.forcing), name_of(*forcing)));
    }
    check_steps(header, record.entries(), session.clock());
    const auto wanted = fluids::fluid_columns(scene).size();
    if (header.numbers != wanted) {
        throw std::invalid_argument(fmt::format(
            "--replay: the record has {} fluid values per probe row, the scene "
            "asks for {}; take the recorded scene's probes.fluid",
            header.numbers, wanted));
    }
    return record;
}

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
