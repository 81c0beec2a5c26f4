// Steady drag of a sphere in an unbounded stream, from three runs: the spacing's error by
// Richardson's extrapolation with the order 2 of interpolated walls, that of the box by
// its doubling, as falling with the square of its width (the blocked area).
#include <gtest/gtest.h>

#include "tests/validation/fluid_lbm/sphere_run.h"

namespace magfsi::fluid {
namespace {

class SphereDragLong : public testing::TestWithParam<double> {};

TEST_P(SphereDragLong, IsThatOfAnUnboundedStream) {
    SphereRun coarse;
    coarse.reynolds = GetParam();
    coarse.diameter = 10;
    coarse.upstream = 4;
    coarse.downstream = 5;
    coarse.sideways = 3;
    coarse.speed = 0.1;
    coarse.convective_times = 20;
    // One collision for all three grids, or the extrapolation compares different errors:
    // the one that `automatic` takes for the smallest relaxation time of the three.
    coarse.collision =
        coarse.reynolds < 50 ? Collision::trt : Collision::recursive_regularized;
    SphereRun fine = coarse, wide = coarse;
    fine.diameter *= 2;
    wide.upstream *= 2;
    wide.sideways *= 2;
    const double c = drag_coefficient(coarse), f = drag_coefficient(fine),
                 w = drag_coefficient(wide), reference = reference_drag(GetParam());
    const double drag = f + (f - c) / 3 + (w - c) * 4 / 3;
    std::printf(
        "Re %g: coarse %.4f, fine %.4f, wide %.4f; unbounded %.4f, reference %.4f, "
        "%+.2f %%\n",
        GetParam(), c, f, w, drag, reference, 100 * (drag / reference - 1));
    EXPECT_LT(std::abs(drag / reference - 1), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Reynolds, SphereDragLong, testing::Values(20, 100, 200));

}  // namespace
}  // namespace magfsi::fluid
