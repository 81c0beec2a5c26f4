// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/output/log.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupler/output/file.h"

namespace magfsi::output {

namespace {

// Standard output without the levels that go to standard error.
class BelowErrorToStdout : public spdlog::sinks::stdout_sink_mt {
  public:
    void log(const spdlog::details::log_msg& message) override {
        if (message.level < spdlog::level::err)
            spdlog::sinks::stdout_sink_mt::log(message);
    }
};

}  // namespace

std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file,
                                         const std::string& name, LogMode mode) {
    if (mode == LogMode::anew)
        File(file)
            .close();  // spdlog would make missing folders and word the failure its way
    auto to_stdout = std::make_shared<BelowErrorToStdout>();
    auto to_stderr = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    auto to_file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
    to_stdout->set_pattern("%v");
    to_stderr->set_pattern("%l: %v");
    to_stderr->set_level(spdlog::level::err);
    to_file->set_pattern("%H:%M:%S.%e %-8l %v");
    auto logger = std::make_shared<spdlog::logger>(
        name, spdlog::sinks_init_list{to_stdout, to_stderr, to_file});
    logger->flush_on(spdlog::level::trace);
    return logger;
}

namespace {

constexpr double terminal_interval_s = 0.2;  // faster is not read
constexpr double plain_interval_s = 10;      // keeps logs of short runs short
constexpr int percent_between_lines = 5;

}  // namespace

ProgressMode detect_progress_mode() {
    return ::isatty(STDOUT_FILENO) != 0 ? ProgressMode::terminal : ProgressMode::plain;
}

Progress::Progress(ProgressMode mode, ProgressGoal goal, Sink sink, Clock clock)
    : mode_(mode),
      goal_(goal),
      sink_(std::move(sink)),
      clock_(std::move(clock)),
      start_s_(clock_()),
      last_s_(start_s_) {}

int Progress::percent(std::int64_t steps_done) const {
    return goal_.steps > 0 ? static_cast<int>(100 * steps_done / goal_.steps) : 100;
}

std::string Progress::line(std::int64_t steps_done, double now_s) const {
    const double share = goal_.steps > 0 ? static_cast<double>(steps_done) /
                                               static_cast<double>(goal_.steps)
                                         : 1.0;
    const double elapsed_s = now_s - start_s_;
    const double done_here = steps_done - goal_.first_step;
    const double rate = elapsed_s > 0 ? done_here / elapsed_s : 0;
    const double left_s = static_cast<double>(goal_.steps - steps_done) / rate;
    return fmt::format("{:3d} %   {:.4g} of {:.4g} s   {:.4g} steps/s   {} left",
                       percent(steps_done), share * goal_.simulated_s, goal_.simulated_s,
                       rate, duration_text(rate > 0 ? left_s : NAN));
}

void Progress::update(std::int64_t steps_done) {
    if (mode_ == ProgressMode::off) return;
    if (mode_ == ProgressMode::plain && percent(steps_done) < next_percent_) return;
    const double now_s = clock_();
    const double interval_s =
        mode_ == ProgressMode::terminal ? terminal_interval_s : plain_interval_s;
    if (now_s - last_s_ < interval_s) return;
    last_s_ = now_s;
    if (mode_ == ProgressMode::terminal) return rewrite(line(steps_done, now_s));
    sink_(line(steps_done, now_s));
    next_percent_ =
        (percent(steps_done) / percent_between_lines + 1) * percent_between_lines;
}

void Progress::rewrite(std::string_view text) {
    // Blanks overwrite the rest of a longer line before.
    const std::size_t blanks = width_ > text.size() ? width_ - text.size() : 0;
    sink_('\r' + std::string(text) + std::string(blanks, ' '));
    width_ = text.size();
}

void Progress::clear() {
    if (mode_ != ProgressMode::terminal || width_ == 0) return;
    sink_('\r' + std::string(width_, ' ') + '\r');
    width_ = 0;
}

void Progress::finish(std::int64_t steps_done) {
    if (mode_ == ProgressMode::off) return;
    const auto text = line(steps_done, clock_());
    if (mode_ == ProgressMode::plain) return sink_(text);
    rewrite(text);
    sink_("\n");
    width_ = 0;
}

std::string duration_text(double seconds) {
    if (!std::isfinite(seconds)) return "?";
    const std::int64_t whole = std::ceil(std::max(0.0, seconds));
    const auto hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
    if (hours > 0) return fmt::format("{}:{:02d}:{:02d}", hours, minutes, rest);
    return fmt::format("{}:{:02d}", minutes, rest);
}

}  // namespace magfsi::output
