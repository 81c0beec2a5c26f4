// Writes exchange.record: each step's messages of all structure ranks, in the order in
// which the markers were placed, so that a record does not know its ranks.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "adapters/lammps/body_coupling.h"
#include "coupler/exchange/exchange_record.h"
#include "coupler/participants/session.h"

namespace magfsi::lammps {

class ExchangeRecorder {
  public:
    // numbers: how many the fluid sends for a probe row. Collective, as record is.
    ExchangeRecorder(const coupler::Session& session, const BodyCoupling& coupling,
                     std::size_t numbers);

    // The fluid's numbers of a probe row; kept for the entries until the next one.
    void keep_numbers(std::span<const double> numbers);

    void record(std::int64_t step);

  private:
    const coupler::Session& session_;
    const BodyCoupling& coupling_;
    std::vector<double> numbers_;
    std::unique_ptr<coupler::RecordWriter> file_;  // on the root
};

}  // namespace magfsi::lammps
