// Aitken's factor on linear maps.
#include "coupler/scheme/acceleration.h"

#include "tests/mpi/coupler/fixed_points.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

TEST(Aitken, one_dimension_is_exact_after_two_iterations) {
    Aitken aitken(MPI_COMM_WORLD, 0.3);
    const LinearMap map = linear_map(1, -4, -4);
    const auto error = errors(aitken, map, 2);
    EXPECT_GT(error[1], 0.1);
    EXPECT_LT(error[2], 1e-14);
    // The factor of Newton's method: 1 / (1 - a).
    EXPECT_NEAR(aitken.omega(), 1.0 / 5, 1e-14);
}

TEST(Aitken, beats_the_constant_factor_that_it_begins_with) {
    const LinearMap map = linear_map(8, -0.5, 0.6);
    for (const double omega : {0.2, 0.5, 0.9}) {
        Aitken aitken(MPI_COMM_WORLD, omega);
        UnderRelaxation constant(omega);
        EXPECT_LT(errors(aitken, map, 12).back(), errors(constant, map, 12).back())
            << omega;
    }
}

TEST(Aitken, converges_where_the_constant_factor_does_not) {
    const LinearMap map = linear_map(4, -5, -4);
    UnderRelaxation constant(0.5);
    EXPECT_GT(errors(constant, map, 12).back(), 100);
    Aitken aitken(MPI_COMM_WORLD, 0.5);
    EXPECT_LT(errors(aitken, map, 12).back(), 1e-6);  // gains a digit an iteration
}

TEST(Aitken, a_step_begins_no_bolder_than_the_user_says) {
    Aitken aitken(MPI_COMM_WORLD, 0.3);
    errors(aitken, linear_map(1, 0.9, 0.9), 2);  // the factor becomes 10
    EXPECT_NEAR(aitken.omega(), 10, 1e-10);
    const auto error = errors(aitken, linear_map(1, 0.9, 0.9), 1);
    EXPECT_NEAR(error[1], 1 - 0.3 * 0.1, 1e-12);
}

}  // namespace
}  // namespace magfsi::coupler
