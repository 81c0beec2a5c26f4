#include "coupler/exchange/message.h"

#include <fmt/format.h>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

void write_header(std::vector<double>& message, std::int64_t step, std::size_t markers) {
    message[0] = static_cast<double>(step);
    message[1] = static_cast<double>(markers);
}

void check_header(std::span<const double> message, std::int64_t step, std::size_t markers,
                  const std::string& sender) {
    const auto got_step = static_cast<std::int64_t>(message[0]);
    const auto got_markers = static_cast<std::size_t>(message[1]);
    if (got_step == step && got_markers == markers) return;
    throw PartnerLost(fmt::format(
        "the two sides are out of step: a message of {} carries step {} with {} markers, "
        "expected step {} with {}",
        sender, got_step, got_markers, step, markers));
}

}  // namespace magfsi::coupler
