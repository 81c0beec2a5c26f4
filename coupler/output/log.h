// SPDX-License-Identifier: GPL-2.0-or-later
// What the person who waits sees of a run: the log and the progress.
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

// Of progress and timings, replaceable in tests: seconds since some fixed instant; never
// goes back.
using Clock = std::function<double()>;

inline double steady_seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

enum class LogMode { anew, append };

// The run's log. Levels below error go to stdout, error and above to stderr, all of it to
// `file` (emptied unless appended to), flushed at every line. Times of day and levels, no
// names of hosts or users. Throws FileError where the file cannot be created. The logger
// is not put into spdlog's registry.
std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file,
                                         const std::string& name,
                                         LogMode mode = LogMode::anew);

// terminal: one line, rewritten; plain: a line at 1 %, 5 %, 10 % ... and at the end, yet
// none within 10 s of the one before; off: nothing.
enum class ProgressMode { terminal, plain, off };

// terminal when file descriptor 1 is one, otherwise plain.
ProgressMode detect_progress_mode();

struct ProgressGoal {
    std::int64_t steps = 0;
    double simulated_s = 0;       // at the last step
    std::int64_t first_step = 0;  // where this run begins (after a restart)
};

// How far a run has come.
class Progress {
  public:
    // plain: one line without line break. terminal: pieces to print and flush as they
    // come.
    using Sink = std::function<void(std::string_view)>;

    Progress(ProgressMode mode, ProgressGoal goal, Sink sink,
             Clock clock = steady_seconds);

    void update(std::int64_t steps_done);  // cheap: call it every step
    void clear();  // takes the terminal's line away, before a log line
    void finish(std::int64_t steps_done);  // the last line, whatever was reached

    // " 42 %   0.0168 of 0.04 s   210 steps/s   1:23 left"
    std::string line(std::int64_t steps_done, double now_s) const;

  private:
    int percent(std::int64_t steps_done) const;
    void rewrite(std::string_view text);

    ProgressMode mode_;
    ProgressGoal goal_;
    Sink sink_;
    Clock clock_;
    double start_s_;
    double last_s_;          // when a line was last given
    int next_percent_ = 1;   // plain mode
    std::size_t width_ = 0;  // of the terminal's line as it stands
};

// "1:23", "2:05:09"; "?" when it is not known.
std::string duration_text(double seconds);

}  // namespace magfsi::output
