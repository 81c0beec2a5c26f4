// A marker outside a walled box has no fluid to meet: the run ends and says where.
#include <gtest/gtest.h>

#include <limits>

#include "coupler/exchange/partner_table.h"
#include "coupler/immersed_boundary/marker_stencil.h"
#include "coupler/participants/errors.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using testing::cut_grid;

// 2 x 2 x 4 mm, periodic along y.
const Grid grid = cut_grid({10, 10, 20}, {false, true, false}, {1, 2, 2});

std::string message_at(const Vec3& point_m) {
    try {
        marker_stencil(grid, Kernel::three_point, point_m);
    } catch (const Diverged& e) {
        return e.what();
    }
    return "no exception";
}

TEST(LeavingTheBox, the_message_holds_the_point_and_the_box) {
    const std::string message = message_at({1e-3, 1e-3, 4.25e-3});
    EXPECT_NE(message.find("(1, 1, 4.25) mm"), std::string::npos) << message;
    EXPECT_NE(message.find("2 x 2 x 4 mm"), std::string::npos) << message;
    EXPECT_NE(message.find("fluid.box"), std::string::npos) << message;
}

TEST(LeavingTheBox, by_any_wall_and_by_any_amount) {
    for (const double out : {1e-9, 1e-4, 1.0}) {
        for (const Vec3& point : {Vec3{-out, 1e-3, 1e-3}, Vec3{2e-3 + out, 1e-3, 1e-3},
                                  Vec3{1e-3, 1e-3, -out}, Vec3{1e-3, 1e-3, 4e-3 + out}}) {
            EXPECT_THROW(marker_stencil(grid, Kernel::two_point, point), Diverged) << out;
        }
    }
}

TEST(LeavingTheBox, a_periodic_side_is_no_way_out) {
    EXPECT_NO_THROW(marker_stencil(grid, Kernel::four_point, {1e-3, -7e-3, 1e-3}));
    EXPECT_NO_THROW(marker_stencil(grid, Kernel::four_point, {1e-3, 7e-3, 1e-3}));
}

TEST(LeavingTheBox, no_position_at_all) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, inf, -inf}) {
        EXPECT_THROW(marker_stencil(grid, Kernel::three_point, {bad, 0, 0}), Diverged);
        EXPECT_THROW(marker_stencil(grid, Kernel::three_point, {0, bad, 0}), Diverged);
    }
}

// No rank's margin reaches that far: without a word the body would be alone in a vacuum.
TEST(LeavingTheBox, far_outside_is_noticed_when_partners_are_chosen) {
    const std::vector<Vec3> points{{1e-3, 1e-3, 1e-3}, {1e-3, 1e-3, 9e-3}};
    EXPECT_THROW(partner_table(grid, Kernel::three_point, points), Diverged);
}

}  // namespace
}  // namespace magfsi::coupler
