// A marker that outruns the partner table ends the run before a cell is missed in
// silence.
#include <gtest/gtest.h>

#include <limits>

#include "coupler/exchange/partner_table.h"
#include "coupler/participants/errors.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

const Grid grid = testing::cut_grid({20, 20, 20}, {true, true, true});
const double h = grid.spacing_m;
const std::vector<Vec3> then{{h, h, h}, {5 * h, 5 * h, 5 * h}};

std::vector<Vec3> second_moved_by(std::size_t axis, double cells) {
    std::vector<Vec3> now = then;
    now[1][axis] += cells * h;
    return now;
}

TEST(CheckMargin, up_to_the_margin_is_allowed) {
    for (const std::size_t axis : {0u, 1u, 2u}) {
        EXPECT_NO_THROW(check_margin(grid, then, second_moved_by(axis, 1.999), 5));
        EXPECT_NO_THROW(check_margin(grid, then, second_moved_by(axis, -1.999), 5));
    }
}

TEST(CheckMargin, beyond_it_names_step_marker_and_distance) {
    for (const std::size_t axis : {0u, 1u, 2u}) {
        EXPECT_THROW(check_margin(grid, then, second_moved_by(axis, -2.001), 5),
                     Diverged);
        try {
            check_margin(grid, then, second_moved_by(axis, 2.5), 1234);
            ADD_FAILURE() << "no exception";
        } catch (const Diverged& e) {
            const std::string message = e.what();
            EXPECT_NE(message.find("step 1234"), std::string::npos) << message;
            EXPECT_NE(message.find("marker 1"), std::string::npos) << message;
            EXPECT_NE(message.find("2.5 cells"), std::string::npos) << message;
        }
    }
}

TEST(CheckMargin, a_nan_has_left_as_well) {
    auto now = then;
    now[0][2] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(check_margin(grid, then, now, 0), Diverged);
}

}  // namespace
}  // namespace magfsi::coupler
