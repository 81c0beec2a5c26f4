// A bending, turning strip that starts as a tilted C, on one rank and on all of the
// world's.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double out = 0;
    for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, std::abs(a[i] - b[i]));
    return out;
}

class AnyRanks : public ::testing::TestWithParam<ElementVariant> {};

TEST_P(AnyRanks, GiveTheSameMotionEnergiesAndWork) {
    LammpsInput input = test::strip_in_field(GetParam());
    Placement placement;
    placement.relaxed = ConstantField{17e-3, 4.4};
    placement.rotation = PlaneRotation{{0, 2}, 0.3};
    placement.position_m = Vec3{8e-3, 4e-3, 4e-3};
    input.placements = {placement};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag_rate_1_s = 20;
    const test::SharedFolder folder;
    test::AloneAndTogether runs(folder.write(input));
    runs.command("run 0");
    runs.command("run 200 pre no post no");
    runs.command("run 200 pre no post no");
    auto& [alone, together] = runs;
    const double difference = largest_difference(alone.gather("x"), together.gather("x"));
    const double difference_v =
        largest_difference(alone.gather("v"), together.gather("v"));
    // Sums of element forces in another order, where positions of 1 cm are rounded by
    // 1e-18 m a step, over 400 steps. Velocities feel a rounded position within a step.
    const double tolerance_m = 1e-13 * 3.7e-3;
    EXPECT_LT(difference, tolerance_m);
    EXPECT_LT(difference_v, tolerance_m / input.time_step_s);
    for (int entry = 0; entry < 4; ++entry) {
        const double a = alone.fix_value("magttice_strip", entry);
        const double b = together.fix_value("magttice_strip", entry);
        // The work of 400 steps is a difference of larger terms.
        EXPECT_NEAR(a / b, 1, 1e-9) << entry;
    }
    std::printf("after 400 steps: %.2g m, %.2g m/s apart\n", difference, difference_v);
}

INSTANTIATE_TEST_SUITE_P(Elements, AnyRanks,
                         ::testing::Values(ElementVariant::full, ElementVariant::mean_f));

}  // namespace
}  // namespace magfsi::structure
