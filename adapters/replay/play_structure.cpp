// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-replay-structure: plays the structure of a recorded run to a live fluid, which
// is so looked at alone.
//   mpirun -n 1 magfsi-replay-structure SCENE --out DIR --replay RUN/exchange.record
//        : -n 2 magfsi-fluid-lbm SCENE --out DIR
#include "adapters/fluids/fluid_probes.h"
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

class Player {
  public:
    Player(const scene::Scene& scene, coupler::Session& session,
           coupler::RecordReader record, output::ProgressMode mode)
        : scene_(scene),
          session_(session),
          record_(std::move(record)),
          grid_(coupler::grid_from_text(coupler::swap_text(
              session.world(), "", coupler::no_timeout_s, "description of the grid"))),
          exchange_(session.world(), grid_, scene.coupling->immersed_boundary.kernel,
                    session.timeout_s(), record_.header().forcing),
          velocity_(record_.header().markers),
          difference_(session, "m/s"),
          progress_(coupler::progress_on_stdout(session, mode)) {
        assemble();
    }

    void run() {
        coupler::log_steps(session_, tasks_);
        entry_ = record_.read(0);
        exchange_.send(-1, entry_.position_m, std::vector<Vec3>(velocity_.size()),
                       entry_.position_m, entry_.volume_m3);
        receive(-1);
        if (probes_ && !session_.restart()) write_probes();
        const double start = output::steady_seconds();
        while (session_.running()) tasks_.run();
        finish(output::steady_seconds() - start);
    }

  private:
    void assemble() {
        tasks_.add("read record", [this] {
            before_m_ = std::move(entry_.position_m);
            entry_ = record_.read(session_.clock().steps_here() + 1);
        });
        tasks_.add_coupling("send impulses", [this] {
            exchange_.send(session_.clock().step(), before_m_, entry_.impulse,
                           entry_.position_m, entry_.volume_m3);
        });
        tasks_.add_coupling("wait for fluid",
                            [this] { receive(session_.clock().step()); });
        tasks_.add("count step", [this] { session_.complete_step(); });
        tasks_.add_output("compare",
                          [this] { difference_.add(velocity_, entry_.velocity); });
        if (record_.header().numbers > 0) {
            probes_ = coupler::open_probes(session_, fluids::fluid_columns(scene_));
            const auto every = session_.clock().every(scene_.probes->every_s);
            tasks_.add_output("probes", [this, every] {
                if (session_.clock().step() % every == 0) write_probes();
            });
        }
        tasks_.add_output("progress",
                          [this] { progress_->update(session_.clock().step()); });
    }

    void receive(std::int64_t step) {
        const bool no_slip = record_.header().forcing == coupler::Forcing::no_slip;
        exchange_.receive(step, velocity_, no_slip ? &answer_ : nullptr);
    }

    void write_probes() {
        std::vector<double> row(record_.header().numbers);
        coupler::receive_numbers(session_.world(), session_.clock().step(), row,
                                 session_.timeout_s());
        probes_->row(session_.clock().time_s(), row);
    }

    void finish(double wall_s) {
        std::vector<coupler::ParticipantReport> reports{
            coupler::basic_report(session_.world(), tasks_)};
        reports.front().name = "structure (replay)";
        reports.push_back(coupler::receive_report(session_));
        progress_->finish(session_.clock().step());
        coupler::write_summary(session_, reports, wall_s, probes_.get());
        difference_.report("the fluid's velocities at the markers");
        session_.log(coupler::end_line(session_, wall_s));
    }

    const scene::Scene& scene_;
    coupler::Session& session_;
    coupler::RecordReader record_;
    coupler::Grid grid_;
    coupler::StructureExchange exchange_;
    coupler::TaskList tasks_;
    coupler::RecordEntry entry_;
    std::vector<Vec3> before_m_, velocity_;
    coupler::NoSlipAnswer answer_;  // not compared: what follows from it is
    DifferenceFile difference_;
    std::unique_ptr<output::ProbeFile> probes_;
    std::unique_ptr<output::Progress> progress_;
};

}  // namespace

}  // namespace magfsi::replay

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::structure,
        "The structure of a recorded run, played to a live fluid", argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            session.begin(*scene::coupled_step_s(scene));
            replay::Player(scene, session, replay::open_record(scene, arguments, session),
                           arguments.progress)
                .run();
        });
}
