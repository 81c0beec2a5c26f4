// SPDX-License-Identifier: GPL-2.0-or-later
// How a run can end other than well. Each maps to one exit code of the command line.
#pragma once

#include <stdexcept>

namespace magfsi::coupler {

enum ExitCode {
    exit_done = 0,
    exit_error = 1,
    exit_input = 2,
    exit_diverged = 3,
    exit_partner = 4
};

// The numbers left the range in which they mean anything: names what, where and when.
class Diverged : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A partner never came, went away, disagrees, or did not answer in time.
class PartnerLost : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// It lives, but did not answer in time.
class TimedOut : public PartnerLost {
  public:
    using PartnerLost::PartnerLost;
};

// Told to end (SIGTERM or SIGINT).
class Stopped : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace magfsi::coupler
