#include "coupler/exchange/message.h"

#include <fmt/format.h>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

std::string in_words(const Occasion& when) {
    if (when.iteration == 0) return fmt::format("step {}", when.step);
    return fmt::format("step {}, iteration {}", when.step, when.iteration);
}

}  // namespace

void write_header(std::vector<double>& message, const Occasion& when,
                  std::size_t markers) {
    message[0] = static_cast<double>(when.step);
    message[1] = static_cast<double>(when.iteration);
    message[2] = static_cast<double>(markers);
}

void check_header(std::span<const double> message, const Occasion& when,
                  std::size_t markers, const std::string& sender) {
    const Occasion got(static_cast<std::int64_t>(message[0]),
                       static_cast<int>(message[1]));
    const auto got_markers = static_cast<std::size_t>(message[2]);
    const bool now = got.step == when.step && got.iteration == when.iteration;
    if (now && got_markers == markers) return;
    throw PartnerLost(fmt::format(
        "the two sides are out of step: a message of {} carries {} with {} markers, "
        "expected {} with {}",
        sender, in_words(got), got_markers, in_words(when), markers));
}

}  // namespace magfsi::coupler
