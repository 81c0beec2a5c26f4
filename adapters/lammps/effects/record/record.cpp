#include "adapters/lammps/effects/record/exchange_recorder.h"
#include "adapters/lammps/structure_run.h"
#include "adapters/scene/probe_columns.h"

namespace magfsi::lammps {

namespace {

class Record : public coupler::Output {
  public:
    explicit Record(StructureRun& run)
        : session_(run.session),
          recorder_(session_, *run.coupling, scene::fluid_columns(run.scene).size()) {
        run.heard = [this](std::span<const double> of_fluid) {
            recorder_.keep_numbers(of_fluid);
        };
    }
    void begin() override { end_step(); }
    void end_step() override { recorder_.record(session_.clock().step() - 1); }

  private:
    const coupler::Session& session_;
    ExchangeRecorder recorder_;
};

void check(const StructureRun& run) {
    if (!run.coupling)
        throw std::invalid_argument("--record: without a fluid nothing is exchanged");
    if (run.coupling->iterates())
        throw std::invalid_argument(
            "--record: coupling.immersed_boundary.iterations above 1 exchange more "
            "messages a step than a record holds; take iterations: 1");
    if (run.coupling->repetitions()) {
        throw std::invalid_argument(
            "--record: an implicit step has many exchanges, which cannot be played; take "
            "coupling.scheme: serial");
    }
}

}  // namespace

extern const StructureOutput record_output{
    "record", "record exchange",
    [](StructureRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.recorded) return nullptr;
        check(run);
        return std::make_unique<Record>(run);
    }};

}  // namespace magfsi::lammps
