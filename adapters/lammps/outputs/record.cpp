// SPDX-License-Identifier: GPL-2.0-or-later
// The file exchange.record: each step's messages of all structure ranks, in the order in
// which the markers were placed, so that the file does not depend on the number of ranks.
#include <algorithm>

#include "adapters/fluids/fluid_probes.h"
#include "adapters/lammps/structure_run.h"
#include "coupler/checkpoint/rank_rows.h"
#include "coupler/exchange/exchange.h"
#include "coupler/exchange/exchange_record.h"

namespace magfsi::lammps {

namespace {

class Record : public coupler::Output {
  public:
    explicit Record(StructureRun& run);
    void begin() override { end_step(); }
    void end_step() override;

  private:
    const coupler::Session& session_;
    const coupler::StructureCoupling& coupling_;
    const coupler::Forcing forcing_;
    std::vector<double> fluid_values_;  // values of the fluid in the last probe row
    std::unique_ptr<coupler::RecordWriter> file_;  // on the root
};

Record::Record(StructureRun& run)
    : session_(run.session),
      coupling_(*run.coupling),
      forcing_(run.scene.coupling->immersed_boundary.forcing.value()),
      fluid_values_(fluids::fluid_columns(run.scene).size()) {
    run.on_fluid_values = [this](std::span<const double> values) {
        std::ranges::copy(values, fluid_values_.begin());
    };
    if (!session_.world().root()) return;
    coupler::RecordHeader header;
    header.step_s = session_.clock().step_s();
    header.first_step = session_.clock().first_step();
    header.markers = coupling_.placed();
    header.numbers = fluid_values_.size();
    header.grid = coupling_.grid();
    header.forcing = forcing_;
    file_ = std::make_unique<coupler::RecordWriter>(session_.out() / coupler::record_name,
                                                    header);
}

// A row for each marker: its position [m], impulse on the fluid [N s] and the fluid's
// velocity there [m/s], in forcing no_slip also volume [m3], row sum [-] and the velocity
// that passed it [m/s]. Collective.
void Record::end_step() {
    const std::size_t width = coupler::record_values_of(forcing_);
    const auto own = coupling_.exchanged();
    std::vector<double> rows(width * own.position_m.size());
    for (std::size_t m = 0; m < own.position_m.size(); ++m) {
        coupler::put(&rows[width * m], own.position_m[m]);
        coupler::put(&rows[width * m + 3], own.impulse[m]);
        coupler::put(&rows[width * m + 6], own.velocity[m]);
        if (!own.no_slip) continue;
        rows[width * m + 9] = own.volume_m3[m];
        rows[width * m + 10] = own.no_slip->row_sum[m];
        coupler::put(&rows[width * m + 11], own.no_slip->passed[m]);
    }
    const auto all =
        coupler::gather_rows(session_.world().local(), coupling_.placed_index(), rows,
                             width, coupling_.placed());
    if (file_) file_->append(session_.clock().step() - 1, fluid_values_, all);
}

// Throws std::invalid_argument on runs that a record cannot represent.
void check(const StructureRun& run) {
    if (!run.coupling)
        throw std::invalid_argument("--record: without a fluid nothing is exchanged");
    const auto& options = *run.scene.coupling;
    if (options.immersed_boundary.iterations > 1)
        throw std::invalid_argument(
            "--record: coupling.immersed_boundary.iterations above 1 exchange more "
            "messages per step than a record holds; take iterations: 1");
    if (options.scheme == coupler::Scheme::implicit) {
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
