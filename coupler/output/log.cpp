#include "coupler/output/log.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "coupler/output/file.h"

namespace magfsi::output {
namespace {

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

}  // namespace magfsi::output
