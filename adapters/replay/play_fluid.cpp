// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-replay-fluid: plays the fluid of a recorded run to a live structure, which is so
// looked at alone.
//   mpirun -n 1 magfsi-structure SCENE --out DIR
//        : -n 1 magfsi-replay-fluid SCENE --out DIR --replay RUN/exchange.record
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "adapters/replay/replay.h"
#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/grid.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/waiting.h"
#include "coupler/participants/world.h"
#include "coupler/step/report.h"
#include "coupler/step/task_list.h"

namespace magfsi::replay {

namespace {

using coupler::Vec3;

std::vector<std::size_t> by_place(std::span<const Vec3> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return points[i]; });
    return order;
}

// Of each live marker the recorded one that starts at its place: the live structure may
// have other ranks, and so another order.
std::vector<std::size_t> pair_up(std::span<const Vec3> live,
                                 std::span<const Vec3> recorded) {
    const auto mine = by_place(live);
    const auto theirs = by_place(recorded);
    std::vector<std::size_t> pairs(live.size());
    bool same = live.size() == recorded.size();
    for (std::size_t i = 0; same && i < live.size(); ++i) {
        same = live[mine[i]] == recorded[theirs[i]];
        pairs[mine[i]] = theirs[i];
    }
    if (!same) {
        throw std::invalid_argument(fmt::format(
            "--replay: the record has {} markers, this run {}, or they start elsewhere; "
            "take the bodies, fluid.spacing and coupling.immersed_boundary of the "
            "recorded scene",
            recorded.size(), live.size()));
    }
    return pairs;
}

template <class T>
std::vector<T> in_order(const std::vector<T>& recorded,
                        std::span<const std::size_t> pairs) {
    std::vector<T> sorted(pairs.size());
    std::ranges::transform(pairs, sorted.begin(),
                           [&](std::size_t i) { return recorded[i]; });
    return sorted;
}

class Player {
  public:
    Player(const scene::Scene& scene, coupler::Session& session,
           coupler::RecordReader record)
        : scene_(scene),
          session_(session),
          record_(std::move(record)),
          exchange_(session.world(), session.timeout_s(), record_.header().forcing),
          difference_(session, "m") {
        coupler::Grid grid = record_.header().grid;
        grid.owned_by_rank = {{{{0, 0, 0}, grid.cells}}};
        grid.follows = false;
        grid.renewal = {};
        coupler::swap_text(session.world(), coupler::to_text(grid), coupler::no_timeout_s,
                           "description of the grid");
        assemble();
    }

    void run() {
        coupler::log_steps(session_, tasks_);
        entry_ = record_.read(0);
        pairs_ = pair_up(exchange_.receive(-1).now_m, entry_.position_m);
        answer(-1);
        if (sends_numbers() && !session_.restart()) send_numbers();
        while (session_.running()) tasks_.run();
        difference_.report("the structure's markers");
        auto report = coupler::basic_report(session_.world(), tasks_);
        report.name = "fluid (replay)";
        coupler::send_report(session_, report);
    }

  private:
    bool sends_numbers() const { return record_.header().numbers > 0; }

    void answer(std::int64_t step) {
        const auto velocity = in_order(entry_.velocity, pairs_);
        if (record_.header().forcing == coupler::Forcing::penalty)
            return exchange_.send(step, velocity);
        const coupler::NoSlipAnswer more{in_order(entry_.answer.row_sum, pairs_),
                                         in_order(entry_.answer.passed, pairs_)};
        exchange_.send(step, velocity, &more);
    }

    void send_numbers() {
        coupler::send_numbers(session_.world(), session_.clock().step(), entry_.numbers,
                              session_.timeout_s());
    }

    void assemble() {
        tasks_.add_coupling("wait for structure", [this] {
            batch_ = &exchange_.receive(session_.clock().step());
        });
        tasks_.add("read record",
                   [this] { entry_ = record_.read(session_.clock().steps_here() + 1); });
        tasks_.add("count step", [this] { session_.complete_step(); });
        tasks_.add_coupling("send velocities",
                            [this] { answer(session_.clock().step() - 1); });
        tasks_.add_output("compare", [this] {
            difference_.add(batch_->now_m, in_order(entry_.position_m, pairs_));
        });
        if (!sends_numbers()) return;
        const auto every = session_.clock().every(scene_.probes->every_s);
        tasks_.add_output("probes", [this, every] {
            if (session_.clock().step() % every == 0) send_numbers();
        });
    }

    const scene::Scene& scene_;
    coupler::Session& session_;
    coupler::RecordReader record_;
    coupler::FluidExchange exchange_;
    DifferenceFile difference_;
    coupler::TaskList tasks_;
    coupler::RecordEntry entry_;
    const coupler::MarkerBatch* batch_ = nullptr;
    std::vector<std::size_t> pairs_;  // the recorded marker of each live one
};

}  // namespace

}  // namespace magfsi::replay

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::fluid, "The fluid of a recorded run, played to a live structure",
        argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            session.begin(*scene::coupled_step_s(scene));
            replay::Player(scene, session, replay::open_record(scene, arguments, session))
                .run();
        });
}
