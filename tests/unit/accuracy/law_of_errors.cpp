// error = C n^-p is found again from runs that follow it, whatever they were compared
// with.
#include <gtest/gtest.h>

#include <cmath>

#include "adapters/magfsi/accuracy/law.h"
#include "adapters/magfsi/accuracy/study_rows.h"

namespace magfsi::launch {
namespace {

constexpr double constant = 1.3, order = 1.75;
// The order is sought in steps of 0.01; on a grid point, rounding is left.
constexpr double rounding = 1e-9;

double law(double n) {
    return constant * std::pow(n, -order);
}

TEST(LawOfErrors, is_found_against_an_exact_reference) {
    const ErrorLaw found = fit_law({{4, law(4)}, {9, law(9)}, {17, law(17)}});
    EXPECT_NEAR(found.order, order, rounding);
    EXPECT_NEAR(found.constant, constant, rounding);
    EXPECT_NEAR(found.error(found.resolution(0.02)), 0.02, rounding);
    EXPECT_EQ(found.coarsest, 4);
    EXPECT_EQ(found.finest, 17);
}

// What is compared with a run of 32 lacks that run's own error.
TEST(LawOfErrors, is_found_against_the_finest_run) {
    const double own = law(32);
    const ErrorLaw found =
        fit_law({{8, law(8) - own}, {16, law(16) - own}, {24, law(24) - own}}, 32);
    EXPECT_NEAR(found.order, order, rounding);
    EXPECT_NEAR(found.constant, constant, rounding);
    EXPECT_EQ(found.finest, 32);
}

TEST(LawOfErrors, is_exceeded_by_no_run) {
    const std::vector<StudiedRun> runs{{4, 0.1}, {8, 0.02}, {16, 0.009}, {32, 0.0021}};
    const ErrorLaw found = fit_law(runs);
    for (const StudiedRun& run : runs)
        EXPECT_GE(found.error(run.resolution), run.error * (1 - rounding));
}

TEST(LawOfErrors, needs_two_resolutions) {
    EXPECT_THROW(fit_law({}), std::invalid_argument);
    EXPECT_THROW(fit_law({{4, 0.1}, {4, 0.2}}), std::invalid_argument);
}

TEST(StudyRows, are_chosen_by_their_columns) {
    const auto rows = parse_rows(
        "element,along[1],error[1],cause\nfull,4,0.8,\nfull,8,,reference\n"
        "mean_f,4,0.1,a, b\n");
    ASSERT_EQ(rows.size(), 3U);
    const auto along = [](const StudyRow& row) { return number_in(row, "along[1]"); };
    const auto runs = runs_where(rows, {{"element", "full"}}, along);
    ASSERT_EQ(runs.size(), 1U);  // the one without an error tells none
    EXPECT_EQ(runs[0].resolution, 4);
    EXPECT_EQ(runs[0].error, 0.8);
}

TEST(StudyRows, are_shipped) {
    EXPECT_GT(study_rows("beam").size(), 20U);
    EXPECT_GT(study_rows("taylor_green_reynolds").size(), 20U);
    EXPECT_TRUE(study_rows("none").empty());
}

}  // namespace
}  // namespace magfsi::launch
