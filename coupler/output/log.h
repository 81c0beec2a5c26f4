// The run's log: to the terminal and to run.log.
#pragma once

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>
#include <string>

namespace magfsi::output {

enum class LogMode { anew, append };

// Levels below error go to stdout, error and above to stderr, all of it to `file`
// (emptied unless appended to), flushed at every line. Times of day and levels, no names
// of hosts or users. Throws FileError where the file cannot be created. The logger is not
// put into spdlog's registry.
std::shared_ptr<spdlog::logger> open_log(const std::filesystem::path& file,
                                         const std::string& name,
                                         LogMode mode = LogMode::anew);

}  // namespace magfsi::output
