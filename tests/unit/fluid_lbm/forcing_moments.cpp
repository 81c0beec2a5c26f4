// Guo's source has the moments 0, F and u F + F u. With omega = 0 a forced collision adds
// exactly the source.
#include <gtest/gtest.h>

#include "fluid_lbm/streaming/kernel_choice.h"
#include "tests/unit/fluid_lbm/kernel_row.h"

namespace magfsi::fluid {
namespace {

using reference::Cell;
using reference::Vec3;

constexpr double rounding = 1e-15;  // differences of sums of 19 terms below 0.1

void expect_moments(const Cell& before, const Cell& after, const Vec3& force) {
    using namespace d3q19;
    const Vec3 u = reference::flow(before, force).u;
    double mass = 0;
    for (int q = 0; q < directions; ++q) mass += after[q] - before[q];
    EXPECT_NEAR(mass, 0, rounding);
    for (int a = 0; a < 3; ++a) {
        double momentum = 0;
        for (int q = 0; q < directions; ++q) momentum += c[q][a] * (after[q] - before[q]);
        EXPECT_NEAR(momentum, force[a], rounding);
        for (int b = 0; b < 3; ++b) {
            double stress = 0;
            for (int q = 0; q < directions; ++q) {
                stress += c[q][a] * c[q][b] * (after[q] - before[q]);
            }
            EXPECT_NEAR(stress, u[a] * force[b] + u[b] * force[a], rounding);
        }
    }
}

// A rate of 0 of the even moments; the magic number that gives 0 for the odd ones.
const CollisionParameters no_relaxation{0, 1e300, 0};

class ForcingMoments : public testing::TestWithParam<Collision> {};

TEST_P(ForcingMoments, OfEveryInstructionSet) {
    std::mt19937 random(1);
    std::vector<Cell> cells(13);
    std::vector<Vec3> force(cells.size());
    for (Cell& cell : cells) cell = reference::random_cell(random);
    for (Vec3& f : force) f = reference::random_force(random);
    for (const NamedKernels& set : available_kernels()) {
        SCOPED_TRACE(set.name);
        const auto kernels = std::get<ChosenKernels<double>>(
            run_kernels(set.kernels, Precision::double_, GetParam(), false));
        const auto out = collide(kernels.rows.forced, cells, force, no_relaxation);
        for (std::size_t x = 0; x < cells.size(); ++x) {
            expect_moments(cells[x], out[x], force[x]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Collisions, ForcingMoments,
                         testing::Values(Collision::bgk, Collision::trt,
                                         Collision::recursive_regularized));

}  // namespace
}  // namespace magfsi::fluid
