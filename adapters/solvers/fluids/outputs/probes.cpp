// SPDX-License-Identifier: GPL-2.0-or-later
// Rows of probes.csv of a fluid that runs alone. Beside a structure, which writes the
// file, the fluid's values are sent to it for each of its rows.
#include "adapters/solvers/fluids/fluid_probes.h"
#include "adapters/solvers/fluids/fluid_run.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/world.h"
#include "coupler/step/report.h"

namespace magfsi::fluids {

namespace {

// Every probe interval: computes the fluid's columns on all ranks; the leading rank
// writes them, or the root sends them to the structure together with the audited sums of
// the steps since the last row.
class Probes : public coupler::Output {
  public:
    explicit Probes(FluidRun& run)
        : run_(run),
          session_(run.session),
          every_(session_.clock().every(run.scene.probes->every_s)) {
        if (session_.world().leads())
            file_ = coupler::open_probes(session_, fluid_columns(run.scene));
    }
    void begin() override {
        if (!session_.restart()) write();
    }
    void end_step() override {
        if (session_.clock().step() % every_ == 0) write();
    }
    const output::ProbeFile* probes() const override { return file_.get(); }

  private:
    void write() {
        std::vector<double> numbers = fluid_values(run_.scene, run_.fluid);
        if (!session_.world().coupled()) {
            if (file_) file_->row(session_.clock().time_s(), numbers);
            return;
        }
        if (run_.balance) {
            const auto received = run_.balance->collect(session_.world().local());
            numbers.insert(numbers.end(), received.begin(), received.end());
        }
        if (session_.world().root()) {
            coupler::send_numbers(session_.world(), session_.clock().step(), numbers,
                                  session_.timeout_s());
        }
    }

    FluidRun& run_;
    const coupler::Session& session_;
    std::int64_t every_;
    std::unique_ptr<output::ProbeFile> file_;
};

}  // namespace

extern const FluidOutput probes_output{
    "probes", "probes", [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        const scene::Scene& scene = run.scene;
        if (!scene.probes || (!run.balance && fluid_columns(scene).empty()))
            return nullptr;
        return std::make_unique<Probes>(run);
    }};

}  // namespace magfsi::fluids
