// The two newest checkpoints of which every participant's half is there are kept, however
// far the partner has come with a newer one.
#include <gtest/gtest.h>

#include <set>

#include "coupler/checkpoint/restart.h"
#include "tests/unit/output/temporary_folder.h"

namespace magfsi::coupler {
namespace {

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
