#include "adapters/lammps/effects/record/exchange_recorder.h"

#include <algorithm>

#include "coupler/checkpoint/state_file.h"
#include "coupler/exchange/exchange.h"

namespace magfsi::lammps {

ExchangeRecorder::ExchangeRecorder(const coupler::Session& session,
                                   const BodyCoupling& coupling, std::size_t numbers)
    : session_(session), coupling_(coupling), numbers_(numbers) {
    if (!session.world().root()) return;
    coupler::RecordHeader header;
    header.step_s = session.clock().step_s();
    header.first_step = session.clock().first_step();
    header.markers = coupling.placed();
    header.numbers = numbers;
    header.grid = coupling.grid();
    file_ = std::make_unique<coupler::RecordWriter>(session.out() / coupler::record_name,
                                                    header);
}

void ExchangeRecorder::keep_numbers(std::span<const double> numbers) {
    std::ranges::copy(numbers, numbers_.begin());
}

void ExchangeRecorder::record(std::int64_t step) {
    constexpr std::size_t width = 9;
    const BodyCoupling::Exchanged own = coupling_.exchanged();
    std::vector<double> rows(width * own.position_m.size());
    for (std::size_t m = 0; m < own.position_m.size(); ++m) {
        coupler::put(&rows[width * m], own.position_m[m]);
        coupler::put(&rows[width * m + 3], own.impulse[m]);
        coupler::put(&rows[width * m + 6], own.velocity[m]);
    }
    const auto all =
        coupler::gather_rows(session_.world().local(), coupling_.placed_index(), rows,
                             width, coupling_.placed());
    if (file_) file_->append(step, numbers_, all);
}

}  // namespace magfsi::lammps
