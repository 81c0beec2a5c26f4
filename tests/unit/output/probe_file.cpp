#include "coupler/output/probe_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/unit/output/temporary_folder.h"

using magfsi::output::FileError;
using magfsi::output::ProbeFile;
using magfsi::test::message_of;
using magfsi::test::read;
using magfsi::test::TemporaryFolder;

using Row = std::array<double, 2>;

TEST(ProbeFile, is_complete_after_every_row) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    ProbeFile file(path, {"robot.com_x[m]", "tip_x[m]"});
    EXPECT_EQ(read(path), "t[s],robot.com_x[m],tip_x[m]\n");
    file.row(0, Row{0.1, -3e-7});
    EXPECT_EQ(read(path), "t[s],robot.com_x[m],tip_x[m]\n0,0.1,-3e-07\n");
}

TEST(ProbeFile, values_read_back_to_the_same_double) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    ProbeFile file(path, {"a", "b"});
    const Row values{1.0 / 3.0, std::nextafter(1e-3, 1.0)};
    file.row(std::numeric_limits<double>::denorm_min(), values);
    std::ifstream in(path);
    std::string text;
    std::getline(in, text);
    std::getline(in, text, ',');
    EXPECT_EQ(std::strtod(text.c_str(), nullptr),
              std::numeric_limits<double>::denorm_min());
    std::getline(in, text, ',');
    EXPECT_EQ(std::stod(text), values[0]);
    std::getline(in, text);
    EXPECT_EQ(std::stod(text), values[1]);
}

TEST(ProbeFile, nan_is_written_without_a_sign) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    ProbeFile file(path, {"a", "b"});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    file.row(1, Row{std::copysign(nan, -1.0), -infinity});
    EXPECT_EQ(read(path), "t[s],a,b\n1,nan,-inf\n");
}

TEST(ProbeFile, another_number_of_values_is_refused) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    ProbeFile file(path, {"a"});
    const auto message = message_of<std::invalid_argument>([&] {
        file.row(0, Row{1, 2});
    });
    EXPECT_EQ(message,
              path.string() + ": a row of 2 values was given, but there are 1 columns");
    EXPECT_EQ(read(path), "t[s],a\n");
}

TEST(ProbeFile, names_that_would_break_the_table_are_refused) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    for (const std::string bad : {"", "a,b", "a\nb", "a\"b"})
        EXPECT_THROW(ProbeFile(path, {bad}), std::invalid_argument) << bad;
    EXPECT_THROW(ProbeFile(path, {"a", "a"}), std::invalid_argument);
    EXPECT_THROW(ProbeFile(path, {"t[s]"}), std::invalid_argument);
}

TEST(ProbeFile, a_full_disk_is_named) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    EXPECT_EQ(message_of<FileError>([] { ProbeFile("/dev/full", {"a"}); }),
              "cannot write /dev/full: No space left on device");
}

TEST(ProbeFile, a_disk_that_fills_inside_a_row_leaves_the_last_complete_row) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    ProbeFile file(path, {"a", "b"});
    file.row(0, Row{1, 2});
    const std::string complete = read(path);

    // A limit on the file's size stops the write after 3 bytes of the next row.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_IGN);
    const rlimit tight{complete.size() + 3, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
    const auto message = message_of<FileError>([&] { file.row(0.25, Row{3, 4}); });
    setrlimit(RLIMIT_FSIZE, &before);

    EXPECT_EQ(message, "cannot write " + path.string() + ": File too large");
    EXPECT_EQ(read(path), complete);
    file.row(0.5, Row{5, 6});  // and goes on once there is room
    EXPECT_EQ(read(path), complete + "0.5,5,6\n");
}

TEST(ProbeFile, goes_on_after_the_rows_up_to_a_time) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    std::string whole;
    {
        ProbeFile file(path, {"a", "b"});
        for (const double t : {0.0, 0.1, 0.2, 0.3}) {
            file.row(t, Row{t / 3, -t});
            if (t == 0.2) whole = read(path);
        }
    }
    std::ofstream(path, std::ios::app) << "0.4,1";  // torn
    ProbeFile file(path, {"a", "b"}, 0.1);
    EXPECT_EQ(file.last_row()[0], 0.1 / 3);
    EXPECT_EQ(file.last_row().size(), 2u);
    file.row(0.2, Row{0.2 / 3, -0.2});
    EXPECT_EQ(read(path), whole);
}

TEST(ProbeFile, goes_on_with_its_own_columns_only) {
    TemporaryFolder folder;
    const auto path = folder / "probes.csv";
    ProbeFile(path, {"a", "b"}).row(0, Row{1, 2});
    const std::string before = read(path);
    EXPECT_THROW(ProbeFile(path, {"a", "c"}, 0), std::runtime_error);
    EXPECT_EQ(read(path), before);
    ProbeFile fresh(folder / "new.csv", {"a"}, 5);
    EXPECT_EQ(read(folder / "new.csv"), "t[s],a\n");
    EXPECT_TRUE(fresh.last_row().empty());
}
