// SPDX-License-Identifier: GPL-2.0-or-later
// What is written to a checkpoint's file is what is read, and damage never goes unseen.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <numeric>
#include <set>
#include "coupler/checkpoint/restart.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/output/file.h"
#include "tests/support/checks.h"

namespace magfsi::coupler {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<double>;

constexpr StateHeader header{0xfedcba9876543210ULL, 1'000'000'000'000, 25e-6};

Numbers counted(std::size_t count) {
    Numbers values(count);
    std::iota(values.begin(), values.end(), 0.1);
    return values;
}

void write(const fs::path& path) {
    StateWriter file(path, header);
    file.table("nodes", counted(12), {4, 3});
    file.begin_table("planes", {2, 3, 4}, StoredAs::double_);
    const Numbers all = counted(24);
    file.plane(1, std::span(all).subspan(12));
    file.plane(0, std::span(all).first(12));
    file.commit();
}

TEST(StateFile, gives_back_every_bit) {
    const test::TemporaryFolder folder;
    write(folder / "a.h5");
    const StateReader file(folder / "a.h5");
    EXPECT_EQ(file.header().state_hash, header.state_hash);
    EXPECT_EQ(file.header().step, header.step);
    EXPECT_EQ(file.header().step_s, header.step_s);
    EXPECT_EQ(file.table("nodes"), counted(12));
    EXPECT_EQ(file.shape("nodes"), (std::vector<std::size_t>{4, 3}));
    EXPECT_EQ(file.table("planes"), counted(24));
    Numbers rows(8);  // rows 1 and 2 of plane 1
    file.rows("planes", 1, 1, 3, rows);
    const Numbers all = counted(24);
    EXPECT_EQ(rows, Numbers(all.begin() + 16, all.end()));
    EXPECT_FALSE(file.has("markers"));
    EXPECT_NO_THROW(file.verify());
}

TEST(StateFile, of_floats_gives_back_floats) {
    const test::TemporaryFolder folder;
    const Numbers values{static_cast<float>(1.0 / 3), -static_cast<float>(1e-7)};
    {
        StateWriter file(folder / "a.h5", header);
        file.begin_table("planes", {1, 2}, StoredAs::float_);
        file.plane(0, values);
        file.commit();
    }
    EXPECT_EQ(StateReader(folder / "a.h5").table("planes"), values);
}

TEST(StateFile, equal_states_give_equal_bytes) {
    const test::TemporaryFolder folder;
    write(folder / "a.h5");
    write(folder / "b.h5");
    EXPECT_EQ(test::read(folder / "a.h5"), test::read(folder / "b.h5"));
}

TEST(StateFile, has_its_name_only_when_it_is_complete) {
    const test::TemporaryFolder folder;
    {
        StateWriter file(folder / "a.h5", header);
        file.table("nodes", counted(12), {4, 3});
        EXPECT_FALSE(fs::exists(folder / "a.h5"));
        EXPECT_TRUE(fs::exists(folder / "a.h5.tmp"));
    }
    EXPECT_FALSE(fs::exists(folder / "a.h5.tmp"));  // given up: nothing is left
    write(folder / "a.h5");
    EXPECT_FALSE(fs::exists(folder / "a.h5.tmp"));
}

// Each byte of the numbers, and the file's end anywhere.
TEST(StateFile, damage_is_found) {
    const test::TemporaryFolder folder;
    write(folder / "a.h5");
    const std::string whole = test::read(folder / "a.h5");
    const Numbers all = counted(24);
    const std::string numbers(reinterpret_cast<const char*>(all.data()), 12 * 8);
    const std::size_t at = whole.find(numbers);
    ASSERT_NE(at, std::string::npos);
    const auto is_refused = [&](const std::string& bytes) {
        std::ofstream(folder / "b.h5", std::ios::binary) << bytes;
        const std::string why =
            test::message_of<StateFault>([&] { StateReader(folder / "b.h5").verify(); });
        return why.find("b.h5 is torn") != std::string::npos;
    };
    EXPECT_FALSE(is_refused(whole));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::string damaged = whole;
        damaged[at + i] = static_cast<char>(damaged[at + i] ^ 0x10);
        EXPECT_TRUE(is_refused(damaged)) << i;
    }
    // What a power cut may leave of the last blocks.
    for (std::size_t i = 0; i < whole.size(); i += 5) {
        const std::string zeros(whole.size() - i, '\0');
        EXPECT_EQ(is_refused(whole.substr(0, i) + zeros), whole.substr(i) != zeros) << i;
    }
    for (std::size_t size = 0; size < whole.size(); size += 97)
        EXPECT_TRUE(is_refused(whole.substr(0, size))) << size;
}

TEST(StateFile, a_full_disk_is_named_and_leaves_the_older_file) {
    const test::TemporaryFolder folder;
    write(folder / "a.h5");
    const std::string older = test::read(folder / "a.h5");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_IGN);
    const rlimit tight{4096, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
    const std::string why = test::message_of<output::FileError>([&] {
        StateWriter file(folder / "a.h5", header);
        file.table("nodes", counted(30000), {10000, 3});
        file.commit();
    });
    setrlimit(RLIMIT_FSIZE, &before);
    test::expect_says(why, {"a.h5: File too large"});
    EXPECT_EQ(test::read(folder / "a.h5"), older);
    EXPECT_FALSE(fs::exists(folder / "a.h5.tmp"));
}

TEST(StateFile, a_folder_that_is_missing_is_named) {
    test::expect_refusal<output::FileError>([] { write("/nowhere/a.h5"); },
                                            {"cannot write /nowhere/a.h5"});
}

// The two newest checkpoints of which every participant's half is there are kept, however
// far the partner has come with a newer one.
using Steps = std::vector<std::int64_t>;
const std::vector<Role> both{Role::structure, Role::fluid};

class Kept : public ::testing::Test {
  protected:
    void add(std::int64_t step, const std::vector<Role>& roles) {
        for (const Role role : roles) std::ofstream(checkpoint_file(path(), step, role));
    }
    std::filesystem::path path() const { return folder_ / "."; }
    test::TemporaryFolder folder_;
};

TEST_F(Kept, are_the_two_newest_complete_ones) {
    for (const int step : {9, 10, 11}) add(step, both);
    prune_checkpoints(path(), both);
    EXPECT_EQ(steps_found(path()), (Steps{11, 10}));
}

TEST_F(Kept, a_half_written_newer_one_does_not_count) {
    for (const int step : {10, 20}) add(step, both);
    add(30, {Role::structure});
    std::ofstream(folder_ / "checkpoint_0000000030_fluid.h5.tmp");
    prune_checkpoints(path(), both);
    EXPECT_EQ(steps_found(path()), (Steps{30, 20, 10}));
    EXPECT_EQ(steps_complete(path(), both), (Steps{20, 10}));
}

TEST_F(Kept, what_a_killed_run_had_half_deleted_goes) {
    add(10, {Role::fluid});
    for (const int step : {20, 30}) add(step, both);
    prune_checkpoints(path(), both);
    EXPECT_EQ(steps_found(path()), (Steps{30, 20}));
}

TEST_F(Kept, one_participant_alone_makes_it_complete) {
    for (const int step : {1, 2, 3}) add(step, {Role::fluid});
    prune_checkpoints(path(), {Role::fluid});
    EXPECT_EQ(steps_found(path()), (Steps{3, 2}));
}

TEST_F(Kept, a_restart_takes_away_what_lies_ahead_and_what_is_torn) {
    for (const int step : {10, 20, 30}) add(step, both);
    std::ofstream(folder_ / "checkpoint_0000000010_fluid.h5.tmp");
    std::ofstream(folder_ / "probes.csv");
    clear_checkpoints_after(path(), 20);
    EXPECT_EQ(steps_found(path()), (Steps{20, 10}));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "checkpoint_0000000010_fluid.h5.tmp"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "probes.csv"));
}

TEST_F(Kept, other_names_are_no_checkpoints) {
    for (const char* name : {"checkpoint_x_fluid.h5", "checkpoint_.h5", "checkpoint_12",
                             "my_checkpoint_12_fluid.h5", "checkpoint_-1_fluid.h5"}) {
        EXPECT_FALSE(step_in_name(name)) << name;
    }
    EXPECT_EQ(step_in_name("runs/a/checkpoint_0000000012_fluid.h5"), 12);
    EXPECT_EQ(step_in_name(checkpoint_file("a", 12'345'678'901, Role::structure)),
              12'345'678'901);
}

}  // namespace
}  // namespace magfsi::coupler
