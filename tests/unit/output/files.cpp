// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/logger.h>
#include <sys/resource.h>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>
#include "coupler/output/file.h"
#include "coupler/output/log.h"
#include "coupler/output/probe_file.h"
#include "coupler/output/vtk.h"
#include "tests/support/checks.h"

namespace magfsi::output {
namespace {

using namespace test;

namespace fs = std::filesystem;

TEST(AtomicFile, readers_see_the_old_file_until_commit) {
    TemporaryFolder folder;
    const auto path = folder / "summary.json";
    write_atomically(path, "old");
    AtomicFile file(path, Survives::power_cut);
    file.write("new, and longer");
    EXPECT_EQ(read(path), "old");
    file.commit();
    EXPECT_EQ(read(path), "new, and longer");
    EXPECT_FALSE(fs::exists(folder / "summary.json.tmp"));
}

TEST(AtomicFile, dropped_without_commit_leaves_the_old_file_and_no_other) {
    TemporaryFolder folder;
    const auto path = folder / "a.vtu";
    write_atomically(path, "old");
    { AtomicFile(path).write("half"); }
    EXPECT_EQ(read(path), "old");
    EXPECT_FALSE(fs::exists(folder / "a.vtu.tmp"));
}

TEST(AtomicFile, a_full_disk_is_named_and_leaves_the_old_file) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
    TemporaryFolder folder;
    const auto path = folder / "a.vtu";
    write_atomically(path, "old");
    // Every write to /dev/full fails as on a full disk.
    fs::create_symlink("/dev/full", folder / "a.vtu.tmp");
    const auto message = message_of<FileError>([&] { write_atomically(path, "new"); });
    EXPECT_EQ(message, "cannot write " + path.string() + ".tmp: No space left on device");
    EXPECT_EQ(read(path), "old");
}

TEST(AtomicFile, a_folder_that_cannot_hold_the_file_is_named) {
    TemporaryFolder folder;
    const auto missing = folder / "missing/a.vtu";
    EXPECT_EQ(message_of<FileError>([&] { write_atomically(missing, "x"); }),
              "cannot write " + missing.string() + ".tmp: No such file or directory");

    write_atomically(folder / "file", "x");
    const auto under_file = folder / "file/a.vtu";
    EXPECT_EQ(message_of<FileError>([&] { write_atomically(under_file, "x"); }),
              "cannot write " + under_file.string() + ".tmp: Not a directory");

    fs::create_directory(folder / "taken");
    EXPECT_EQ(message_of<FileError>([&] { write_atomically(folder / "taken", "x"); }),
              "cannot write " + (folder / "taken").string() + ": Is a directory");
}

namespace fs = std::filesystem;

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

namespace fs = std::filesystem;

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

namespace fs = std::filesystem;

TEST(PvdSeries, names_files_relative_to_itself_and_is_whole_after_every_add) {
    TemporaryFolder folder;
    const std::string head =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
        "<Collection>\n";
    const std::string tail = "</Collection>\n</VTKFile>\n";
    const std::string first =
        "<DataSet timestep=\"0\" part=\"0\" file=\"body/0.vtu\"/>\n";
    const std::string second =
        "<DataSet timestep=\"0.0025\" part=\"0\" file=\"body/a&amp;b.vtu\"/>\n";

    PvdSeries series(folder / "structure.pvd");
    EXPECT_EQ(read(folder / "structure.pvd"), head + tail);
    series.add(0, folder / "body/0.vtu");
    EXPECT_EQ(read(folder / "structure.pvd"), head + first + tail);
    series.add(2.5e-3, folder / "body/a&b.vtu");
    EXPECT_EQ(read(folder / "structure.pvd"), head + first + second + tail);
}

TEST(PvdSeries, times_must_rise) {
    TemporaryFolder folder;
    PvdSeries series(folder / "a.pvd");
    series.add(1, folder / "1.vtu");
    EXPECT_THROW(series.add(1, folder / "2.vtu"), std::invalid_argument);
    EXPECT_THROW(series.add(0.5, folder / "2.vtu"), std::invalid_argument);
}

TEST(PvdSeries, a_missing_folder_is_found_at_once) {
    TemporaryFolder folder;
    EXPECT_THROW(PvdSeries(folder / "missing/a.pvd"), FileError);
}

// What does not fit is refused before a file is touched.
namespace fs = std::filesystem;

const std::vector<double> points(24);
const std::vector<std::array<int, 8>> one_cell{{0, 1, 2, 3, 4, 5, 6, 7}};
const ImageGrid grid{{0, 0, 0}, {1, 1, 1}};

TEST(Vtu, a_field_of_another_size_is_refused) {
    TemporaryFolder folder;
    const std::vector<double> short_by_one(23);
    const std::vector<Field> fields{{"velocity", 3, short_by_one}};
    const auto message = message_of<std::invalid_argument>([&] {
        write_vtu(folder / "a.vtu", {points, one_cell}, fields, {});
    });
    EXPECT_EQ(message,
              "VTK field 'velocity' has 23 values; 8 points of 3 components need 24");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.vtu"));
}

TEST(Vtu, a_point_that_is_not_there_is_refused) {
    TemporaryFolder folder;
    const std::vector<std::array<int, 8>> beyond{{0, 1, 2, 3, 4, 5, 6, 8}};
    const auto message = message_of<std::invalid_argument>([&] {
        write_vtu(folder / "a.vtu", {points, beyond}, {}, {});
    });
    EXPECT_EQ(message, "hexahedron 0 names point 8; there are 8 points");
}

TEST(Vti, empty_extents_and_spacings_are_refused) {
    TemporaryFolder folder;
    const CellExtent none{{0, 0, 0}, {4, 0, 4}};
    const CellExtent one{{0, 0, 0}, {1, 1, 1}};
    const ImageGrid flat{{0, 0, 0}, {1, 0, 1}};
    EXPECT_THROW(write_vti(folder / "a.vti", grid, none, {}), std::invalid_argument);
    EXPECT_THROW(write_vti(folder / "a.vti", flat, one, {}), std::invalid_argument);
}

TEST(Pvti, pieces_that_miss_overlap_or_leave_the_grid_are_refused) {
    TemporaryFolder folder;
    const CellExtent whole{{0, 0, 0}, {4, 2, 2}};
    const CellExtent left{{0, 0, 0}, {2, 2, 2}}, right{{2, 0, 0}, {4, 2, 2}};
    const CellExtent over{{1, 0, 0}, {3, 2, 2}}, beyond{{2, 0, 0}, {5, 2, 2}};
    const auto with = [&](CellExtent first, CellExtent second) {
        const std::vector<ImagePiece> pieces{{"a.vti", first}, {"b.vti", second}};
        return message_of<std::invalid_argument>(
            [&] { write_pvti(folder / "a.pvti", grid, whole, pieces, {}); });
    };
    EXPECT_EQ(with(left, right), "");
    EXPECT_EQ(with(left, over), "pieces 0 2 0 2 0 2 and 1 3 0 2 0 2 overlap");
    EXPECT_EQ(with(left, beyond),
              "piece 2 5 0 2 0 2 is empty or leaves the grid 0 4 0 2 0 2");
    const std::vector<ImagePiece> half{{"a.vti", left}};
    EXPECT_EQ(message_of<std::invalid_argument>(
                  [&] { write_pvti(folder / "a.pvti", grid, whole, half, {}); }),
              "the pieces hold 8 of the grid's 16 cells");
}

}  // namespace
}  // namespace magfsi::output
