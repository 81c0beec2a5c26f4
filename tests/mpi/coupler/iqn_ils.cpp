// The quasi-Newton acceleration on linear maps, where it must be exact after as many
// iterations as there are dimensions, whatever the map does by itself.
#include "coupler/scheme/acceleration.h"

#include "tests/mpi/coupler/fixed_points.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// Least squares of some 1e-16, magnified by the map's condition of up to 1e3.
constexpr double exact = 1e-10;

coupler::Iteration settings(int reused_steps = 0) {
    coupler::Iteration wanted;
    wanted.reused_steps = reused_steps;
    wanted.filter_limit = 1e-12;
    return wanted;
}

TEST(IqnIls, solves_n_dimensions_in_n_plus_one_iterations) {
    for (const int n : {1, 2, 5, 9}) {
        IqnIls iqn(MPI_COMM_WORLD, settings());
        const auto error = errors(iqn, linear_map(n, -0.5, 0.8), n + 1);
        EXPECT_LT(error.back(), exact) << n;
        if (n == 1) continue;
        EXPECT_GT(error[static_cast<std::size_t>(n)], exact) << n;
    }
}

TEST(IqnIls, converges_where_the_map_itself_diverges) {
    constexpr int n = 6;
    // Relaxed by a half, the worst direction grows by |1 - 0.5 * (1 + 9)| = 4 a step.
    const LinearMap map = linear_map(n, -9, -2);
    UnderRelaxation relaxed(0.5);
    EXPECT_GT(errors(relaxed, map, n + 1).back(), 100);
    IqnIls iqn(MPI_COMM_WORLD, settings());
    EXPECT_LT(errors(iqn, map, n + 1).back(), exact);
}

TEST(IqnIls, what_a_step_taught_serves_the_next) {
    constexpr int n = 6;
    LinearMap map = linear_map(n, -3, 0.7);
    IqnIls iqn(MPI_COMM_WORLD, settings(1));
    errors(iqn, map, n + 1);
    map.b *= -2;  // another step: the same Jacobian
    EXPECT_LT(errors(iqn, map, 1).back(), exact);
    // One that forgets has to start again.
    IqnIls forgetful(MPI_COMM_WORLD, settings(0));
    errors(forgetful, map, n + 1);
    EXPECT_EQ(forgetful.columns(), 0u);
    EXPECT_GT(errors(forgetful, map, 1).back(), exact);
}

TEST(IqnIls, keeps_as_many_columns_and_steps_as_it_may) {
    coupler::Iteration wanted = settings(2);
    wanted.max_used_iterations = 7;
    IqnIls iqn(MPI_COMM_WORLD, wanted);
    const LinearMap map = linear_map(40, -0.9, 0.9);
    errors(iqn, map, 3);
    EXPECT_EQ(iqn.columns(), 3u);
    errors(iqn, map, 3);
    EXPECT_EQ(iqn.columns(), 6u);
    errors(iqn, map, 5);
    EXPECT_EQ(iqn.columns(), 7u);
}

TEST(IqnIls, drops_what_says_nothing_new) {
    // Three dimensions cannot give more than three columns that differ.
    coupler::Iteration wanted = settings(5);
    wanted.filter_limit = 1e-3;
    IqnIls iqn(MPI_COMM_WORLD, wanted);
    LinearMap map = linear_map(3, -3, 0.7);
    for (int step = 0; step < 5; ++step) {
        map.b = Eigen::VectorXd::Random(3);
        errors(iqn, map, 3);
    }
    EXPECT_GT(iqn.dropped(), 0);
    EXPECT_LE(iqn.columns(), 4u);  // the last pair of a step is looked at in the next
    map.b = Eigen::VectorXd::Random(3);
    EXPECT_LT(errors(iqn, map, 2).back(), exact);
}

// Between steps its state is that of its numbers and vectors.
TEST(IqnIls, goes_on_from_what_a_checkpoint_keeps) {
    constexpr int n = 6;
    const LinearMap map = linear_map(n, -3, 0.7);
    IqnIls first(MPI_COMM_WORLD, settings(3)), second(MPI_COMM_WORLD, settings(3));
    errors(first, map, 3);
    second.make_room(first.numbers(), own(map.b).size());
    const auto from = first.vectors();
    const auto to = second.vectors();
    ASSERT_EQ(from.size(), to.size());
    for (std::size_t i = 0; i < to.size(); ++i)
        std::copy(from[i].begin(), from[i].end(), to[i].begin());
    EXPECT_EQ(errors(first, map, 3), errors(second, map, 3));
}

// Nothing moves: every pair is zero.
TEST(IqnIls, at_rest_stays_at_rest) {
    IqnIls iqn(MPI_COMM_WORLD, settings(2));
    std::vector<double> guess = own(Eigen::VectorXd::Zero(5));
    for (int i = 0; i < 4; ++i) iqn.improve(guess, own(Eigen::VectorXd::Zero(5)));
    for (const double value : guess) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace magfsi::coupler
