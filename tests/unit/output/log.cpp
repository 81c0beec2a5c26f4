#include "coupler/output/log.h"

#include <gtest/gtest.h>
#include <spdlog/logger.h>

#include <sstream>

#include "coupler/output/file.h"
#include "tests/unit/output/temporary_folder.h"

using magfsi::output::FileError;
using magfsi::output::open_log;
using magfsi::test::message_of;
using magfsi::test::read;
using magfsi::test::TemporaryFolder;

namespace {

// Drops "12:34:56.789 " of every line, and the line if it does not begin so.
std::string without_times(const std::string& log) {
    const std::string shape = "00:00:00.000 ";
    std::istringstream in(log);
    std::string out;
    for (std::string line; std::getline(in, line);) {
        std::string time = line.substr(0, shape.size());
        for (char& c : time)
            if (c >= '0' && c <= '9') c = '0';
        if (time == shape) out += line.substr(shape.size()) + '\n';
    }
    return out;
}

}  // namespace

TEST(Log, each_stream_gets_its_levels_and_the_file_all_of_them) {
    TemporaryFolder folder;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const auto log = open_log(folder / "run.log", "magfsi");
    log->info("step {}", 7);
    log->error("partner lost");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "step 7\n");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "error: partner lost\n");
    EXPECT_EQ(without_times(read(folder / "run.log")),
              "info     step 7\nerror    partner lost\n");
}

TEST(Log, a_file_that_cannot_be_written_is_named) {
    TemporaryFolder folder;
    const auto path = folder / "missing/run.log";
    EXPECT_EQ(message_of<FileError>([&] { open_log(path, "magfsi"); }),
              "cannot write " + path.string() + ": No such file or directory");
}

TEST(Log, two_logs_in_one_process_do_not_collide) {
    TemporaryFolder folder;
    testing::internal::CaptureStdout();
    const auto first = open_log(folder / "a.log", "magfsi");
    const auto second = open_log(folder / "b.log", "magfsi");
    second->info("here");
    testing::internal::GetCapturedStdout();
    EXPECT_EQ(read(folder / "a.log"), "");
    EXPECT_NE(read(folder / "b.log"), "");
}
