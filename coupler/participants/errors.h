// SPDX-License-Identifier: GPL-2.0-or-later
// The ways in which a run can fail, and the exit codes of the command line.
#pragma once

#include <stdexcept>

namespace magfsi::coupler {

// Exit codes of all programs.
enum ExitCode {
    exit_done = 0,
    exit_error = 1,
    exit_input = 2,
    exit_diverged = 3,
    exit_partner = 4
};

// The numbers left the range in which they mean anything; the message names what, where
// and when.
class Diverged : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A partner never started, went away, disagrees, or did not answer in time.
class PartnerLost : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A partner lives, but did not answer in time.
class TimedOut : public PartnerLost {
  public:
    using PartnerLost::PartnerLost;
};

// The process was told to end by SIGTERM or SIGINT.
class Stopped : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace magfsi::coupler
