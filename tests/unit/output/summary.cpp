// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/output/summary.h"
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "coupler/output/log.h"
#include "tests/support/checks.h"

namespace magfsi::output {
namespace {

using namespace test;

namespace fs = std::filesystem;

Summary diverged_run() {
    Summary s;
    s.scene = "swimmer";
    s.scene_hash = 0xbeef;
    s.outcome = Outcome::diverged;
    s.cause = "element 7 of robot inverted at step 12";
    s.effects = {"magnetic_field", "fluid"};
    s.absent_effects = {"gravity"};
    s.steps = 12;
    s.simulated_s = 2.4e-4;
    s.wall_s = 1.5;
    s.coupling_overhead = 0.03;
    s.advice = "give the fluid more ranks";
    ParticipantReport structure;
    structure.name = "structure";
    structure.versions = {{"magfsi", "0.1.0"}, {"lammps", "29 Sep 2021"}};
    structure.memory_bytes = 50000000;
    structure.add(StructureSummary{108, 33.5, 6, 72, {}});
    ParticipantReport fluid;
    fluid.name = "fluid";
    fluid.processor_s = 2.75;
    fluid.load = {.ranks = 2, .working_s = 1.25, .waiting_s = 0.125, .imbalance = 1.5};
    fluid.tasks = {{"stream", 1.0}, {"exchange", 0.25}};
    fluid.waiting = {{"exchange", 0.125}};
    fluid.add(FluidSummary{128000, 88.5, 0.5015, 2e-4, "recursive_regularized", "avx2"});
    // As the partner receives it.
    s.participants = {structure, ParticipantReport::from_text(fluid.to_text())};
    s.probes = {{"robot.com_z[m]", std::numeric_limits<double>::quiet_NaN()},
                {"robot.bend[rad]", 0.5}};
    s.restarted_at_step = 3;
    return s;
}

TEST(Summary, has_the_keys_that_readers_rely_on) {
    TemporaryFolder folder;
    write_summary(folder / "summary.json", diverged_run());
    const auto json = nlohmann::ordered_json::parse(read(folder / "summary.json"));
    EXPECT_EQ(json["scene"], "swimmer");
    EXPECT_EQ(json["scene_hash"], "000000000000beef");
    EXPECT_EQ(json["outcome"], "diverged");
    EXPECT_EQ(json["cause"], "element 7 of robot inverted at step 12");
    EXPECT_EQ(json["effects"].size(), 2u);
    EXPECT_EQ(json["absent_effects"][0], "gravity");
    EXPECT_EQ(json["versions"]["lammps"], "29 Sep 2021");
    EXPECT_EQ(json["ranks"]["fluid"], 2);
    EXPECT_EQ(json["steps"], 12);
    EXPECT_EQ(json["substeps"], 72);
    EXPECT_EQ(json["simulated_s"], 2.4e-4);
    EXPECT_EQ(json["wall_s"], 1.5);
    EXPECT_EQ(json["tasks"]["fluid"]["exchange"], 0.25);
    EXPECT_EQ(json["waiting"]["fluid"]["exchange"], 0.125);
    EXPECT_EQ(json["load"]["fluid"]["working_s"], 1.25);
    EXPECT_EQ(json["load"]["fluid"]["waiting_s"], 0.125);
    EXPECT_EQ(json["load"]["fluid"]["imbalance"], 1.5);
    EXPECT_EQ(json["coupling_overhead"], 0.03);
    EXPECT_EQ(json["advice"], "give the fluid more ranks");
    EXPECT_EQ(json["fluid"]["cells"], 128000);
    EXPECT_EQ(json["fluid"]["mlups"], 88.5);
    EXPECT_EQ(json["fluid"]["relaxation_time"], 0.5015);
    EXPECT_EQ(json["memory_bytes"]["structure"], 50000000);
    EXPECT_EQ(json["processor_s"]["fluid"], 2.75);
    EXPECT_EQ(json["probes"]["robot.bend[rad]"], 0.5);
    EXPECT_EQ(json["extra"]["restarted_at_step"], 3);
}

TEST(Summary, absent_solvers_have_no_key_and_what_is_not_finite_is_null) {
    EXPECT_FALSE(to_json(Summary{}).contains("structure"));
    const auto json = to_json(diverged_run());
    const auto read_back = nlohmann::ordered_json::parse(json.dump());
    EXPECT_TRUE(read_back["probes"]["robot.com_z[m]"].is_null());
}

TEST(Summary, immersed_boundary_has_its_errors_absolute_and_relative) {
    Summary s;
    EXPECT_FALSE(to_json(s).contains("immersed_boundary"));
    s.participants.emplace_back().add(
        BoundarySummary{4680, 600, 2e-3, 5e-3, 0.02, 3e-10, 0.01, 0.1});
    const auto json = to_json(s)["immersed_boundary"];
    EXPECT_EQ(json["markers"], 4680);
    EXPECT_EQ(json["no_slip_error"], 0.02);
    EXPECT_EQ(json["no_slip_error_m_s"], 2e-3);
    EXPECT_EQ(json["largest_no_slip_error_m_s"], 5e-3);
    EXPECT_EQ(json["leakage"], 0.01);
    EXPECT_EQ(json["leakage_m3_s"], 3e-10);
}

TEST(Summary, keeps_the_order_in_which_it_was_filled) {
    const auto json = to_json(diverged_run());
    EXPECT_EQ(json.begin().key(), "scene");
    EXPECT_EQ(json["versions"].begin().key(), "magfsi");
    EXPECT_EQ(json["tasks"]["fluid"].begin().key(), "stream");
}

TEST(Summary, structure_and_every_outcome_have_their_words) {
    const auto json = to_json(diverged_run());
    EXPECT_EQ(json["structure"]["elements"], 108);
    EXPECT_EQ(json["structure"]["ns_per_element_step"], 33.5);
    EXPECT_EQ(json["structure"]["substeps_per_step"], 6);
    EXPECT_EQ(to_text(Outcome::completed), "completed");
    EXPECT_EQ(to_text(Outcome::lost_partner), "lost_partner");
    EXPECT_EQ(to_text(Outcome::stopped), "stopped");
}

TEST(Summary, a_cause_that_is_not_utf8_does_not_lose_the_summary) {
    TemporaryFolder folder;
    Summary s;
    s.cause = "line \xff of the mesh";
    write_summary(folder / "summary.json", s);
    const auto json = nlohmann::json::parse(read(folder / "summary.json"));
    EXPECT_EQ(json["cause"], "line \xef\xbf\xbd of the mesh");  // U+FFFD
}

namespace fs = std::filesystem;

// 200 steps to 0.04 s, on a clock that the test sets.
struct Rehearsal {
    explicit Rehearsal(ProgressMode mode, std::int64_t first_step = 0)
        : progress(
              mode, {200, 0.04, first_step},
              [this](std::string_view text) { given.emplace_back(text); },
              [this] { return now_s; }) {}

    void advance(std::int64_t step, double seconds) {
        now_s = 1000 + seconds;
        progress.update(step);
    }

    double now_s = 1000;
    std::vector<std::string> given;
    Progress progress;
};

using Lines = std::vector<std::string>;

TEST(Progress, plain_lines_come_at_the_marks) {
    Rehearsal run(ProgressMode::plain);
    for (int step = 1; step <= 24; ++step) run.advance(step, 20.0 * step);
    EXPECT_EQ(run.given,
              (Lines{"  1 %   0.0004 of 0.04 s   0.05 steps/s   1:06:00 left",
                     "  5 %   0.002 of 0.04 s   0.05 steps/s   1:03:20 left",
                     " 10 %   0.004 of 0.04 s   0.05 steps/s   1:00:00 left"}));
}

TEST(Progress, plain_lines_keep_ten_seconds_apart) {
    Rehearsal run(ProgressMode::plain);
    for (int step = 1; step <= 200; ++step) run.advance(step, 0.125 * step);
    run.progress.finish(200);
    EXPECT_EQ(run.given, (Lines{" 40 %   0.016 of 0.04 s   8 steps/s   0:15 left",
                                " 80 %   0.032 of 0.04 s   8 steps/s   0:05 left",
                                "100 %   0.04 of 0.04 s   8 steps/s   0:00 left"}));
}

TEST(Progress, the_terminal_line_is_rewritten_and_the_longer_one_wiped) {
    Rehearsal run(ProgressMode::terminal);
    run.advance(1, 0.1);  // sooner than anyone can read
    EXPECT_TRUE(run.given.empty());
    run.advance(7, 0.5);
    run.advance(50, 1.0);
    ASSERT_EQ(run.given.size(), 2u);
    EXPECT_EQ(run.given[0], "\r  3 %   0.0014 of 0.04 s   14 steps/s   0:14 left");
    EXPECT_EQ(run.given[1], "\r 25 %   0.01 of 0.04 s   50 steps/s   0:03 left  ");
    run.progress.clear();
    EXPECT_EQ(run.given.back(), "\r" + std::string(47, ' ') + "\r");
    run.progress.finish(200);
    EXPECT_EQ(run.given.back(), "\n");
}

TEST(Progress, after_a_restart_only_new_steps_count_for_the_rate) {
    Rehearsal run(ProgressMode::plain, 100);
    run.advance(150, 25);
    EXPECT_EQ(run.given, (Lines{" 75 %   0.03 of 0.04 s   2 steps/s   0:25 left"}));
}

TEST(Progress, off_says_nothing) {
    Rehearsal run(ProgressMode::off);
    run.advance(100, 100);
    run.progress.finish(200);
    EXPECT_TRUE(run.given.empty());
}

TEST(Progress, before_the_first_step_the_time_left_is_not_known) {
    Rehearsal run(ProgressMode::plain);
    EXPECT_EQ(run.progress.line(0, 1000), "  0 %   0 of 0.04 s   0 steps/s   ? left");
}

}  // namespace
}  // namespace magfsi::output
