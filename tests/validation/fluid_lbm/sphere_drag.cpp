// Steady drag of a sphere at Reynolds number 20 on a coarse grid, with both kinds of
// wall.
#include <gtest/gtest.h>

#include "tests/validation/fluid_lbm/sphere_run.h"

namespace magfsi::fluid {
namespace {

double error(ObstacleWall wall) {
    SphereRun run;
    run.reynolds = 20;
    run.diameter = 6;
    run.upstream = 4;
    run.downstream = 6;
    run.sideways = 4;
    run.speed = 0.08;
    run.convective_times = 20;
    run.wall = wall;
    const double drag = drag_coefficient(run), reference = reference_drag(20);
    const double relative = drag / reference - 1;
    std::printf("%s walls: drag coefficient %.4f, reference %.4f, %+.2f %%\n",
                wall == ObstacleWall::half_way ? "half-way" : "interpolated", drag,
                reference, 100 * relative);
    return std::abs(relative);
}

TEST(SphereDrag, IsRightOnACoarseGridAndBetterWithInterpolatedWalls) {
    const double stairs = error(ObstacleWall::half_way);
    const double smooth = error(ObstacleWall::interpolated);
    // 6 cells a diameter, and a box of 8 x 8 diameters across, whose sides raise the drag
    // by 2 % (the difference to a box of 16 x 16).
    EXPECT_LT(smooth, 0.05);
    EXPECT_LT(smooth, stairs);  // why it is the default
}

}  // namespace
}  // namespace magfsi::fluid
