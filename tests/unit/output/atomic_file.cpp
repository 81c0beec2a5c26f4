#include "coupler/output/file.h"

#include <gtest/gtest.h>

#include "tests/unit/output/temporary_folder.h"

namespace fs = std::filesystem;
using magfsi::output::AtomicFile;
using magfsi::output::FileError;
using magfsi::output::Survives;
using magfsi::output::write_atomically;
using magfsi::test::message_of;
using magfsi::test::read;
using magfsi::test::TemporaryFolder;

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
