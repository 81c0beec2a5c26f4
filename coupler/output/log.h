// SPDX-License-Identifier: GPL-2.0-or-later
// The log and the progress that a user sees of a run.
#pragma once

#include <spdlog/fwd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace magfsi::output {

// A source of time for progress and timings, replaceable in tests: seconds since some
// fixed instant, never decreasing.
using Clock = std::function<double()>;

// The clock that production code uses.
inline double steady_seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

// Treatment of an earlier log: emptied, or appended to after a restart.
enum class LogMode { anew, append };

// Opens the run's log. Messages below level error go to stdout, those of error and above
// to stderr, and all of them to `file`, which is flushed at every line. Lines in the file
// carry the time of day and the level, but no names of hosts or users. The logger is not
// registered with spdlog. Throws FileError if the file cannot be created.
std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file,
                                         const std::string& name,
                                         LogMode mode = LogMode::anew);

// Form of the progress. terminal: one line that is rewritten. plain: a line at 1 %, 5 %,
// 10 % ... and at the end, but none within 10 s of the one before. off: nothing.
enum class ProgressMode { terminal, plain, off };

// terminal if standard output is one, otherwise plain.
ProgressMode detect_progress_mode();

// The end of the run, from which the progress is computed.
struct ProgressGoal {
    std::int64_t steps = 0;
    double simulated_s = 0;       // time at the last step [s]
    std::int64_t first_step = 0;  // first step of this run (after a restart)
};

// Prints the share of the run that is done, the speed and the estimated time left.
class Progress {
  public:
    // Receives the text. plain: one line without line break. terminal: pieces that must
    // be printed and flushed at once.
    using Sink = std::function<void(std::string_view)>;

    Progress(ProgressMode mode, ProgressGoal goal, Sink sink,
             Clock clock = steady_seconds);

    // Prints a line if one is due; cheap enough to be called at every step.
    void update(std::int64_t steps_done);
    // Removes the terminal's line, so that a log line can be printed.
    void clear();
    // Prints the last line, whatever step the run has reached.
    void finish(std::int64_t steps_done);

    // A line such as " 42 %   0.0168 of 0.04 s   210 steps/s   1:23 left". The speed is
    // the mean since the start of this run.
    std::string line(std::int64_t steps_done, double now_s) const;

  private:
    int percent(std::int64_t steps_done) const;
    void rewrite(std::string_view text);

    ProgressMode mode_;
    ProgressGoal goal_;
    Sink sink_;
    Clock clock_;
    double start_s_;
    double last_s_;          // time of the last line
    int next_percent_ = 1;   // plain mode only
    std::size_t width_ = 0;  // length of the terminal's line
};

// A duration as "1:23" or "2:05:09"; "?" if it is not finite.
std::string duration_text(double seconds);

}  // namespace magfsi::output
