// Interpolation (eq. 14) and spreading (eq. 15) are adjoint; spreading keeps the force
// and interpolation a uniform velocity.
#include <gtest/gtest.h>

#include <cmath>

#include "coupler/immersed_boundary/touched_rows.h"
#include "tests/unit/coupler/grids.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

constexpr std::size_t markers = 200;

// Sums of some 1e4 products round to about 1e-15 of the sum of their magnitudes.
constexpr double rounding = 1e-13;

class SpreadingAndInterpolation : public ::testing::TestWithParam<Kernel> {
  protected:
    SpreadingAndInterpolation()
        : grid_(cut_grid({13, 11, 9}, {true, false, true})),
          rows_(grid_, grid_.owned_by_rank[0], GetParam()),
          random_(3) {
        rows_.place(random_.points(grid_, markers));
    }

    double cell_volume_m3() const { return std::pow(grid_.spacing_m, 3); }

    Grid grid_;
    TouchedRows rows_;
    Random random_;
};

TEST_P(SpreadingAndInterpolation, are_adjoint) {
    const auto force = random_.vectors(markers, 1e-6);
    std::vector<double> velocity(3 * rows_.cells());
    for (double& u : velocity) u = random_.between(-0.5, 0.5);
    std::vector<Vec3> at_markers(markers);
    rows_.interpolate(velocity, at_markers);
    std::vector<double> density(velocity.size());
    rows_.spread(force, density);

    double power_of_markers = 0;
    double scale = 0;
    for (std::size_t m = 0; m < markers; ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            power_of_markers += force[m][d] * at_markers[m][d];
            scale += std::abs(force[m][d] * at_markers[m][d]);
        }
    }
    double power_of_cells = 0;
    for (std::size_t i = 0; i < density.size(); ++i) {
        power_of_cells += density[i] * velocity[i] * cell_volume_m3();
    }
    std::printf("power: relative difference %.1e\n",
                std::abs(power_of_markers - power_of_cells) / scale);
    EXPECT_NEAR(power_of_markers, power_of_cells, rounding * scale);
}

TEST_P(SpreadingAndInterpolation, spreading_keeps_the_total_force) {
    const auto force = random_.vectors(markers, 1e-6);
    std::vector<double> density(3 * rows_.cells());
    rows_.spread(force, density);
    Vec3 total{};
    Vec3 expected{};
    for (std::size_t i = 0; i < density.size(); ++i)
        total[i % 3] += density[i] * cell_volume_m3();
    for (const Vec3& f : force)
        for (std::size_t d = 0; d < 3; ++d) expected[d] += f[d];
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_NEAR(total[d], expected[d], rounding * markers * 1e-6) << "axis " << d;
    }
}

TEST_P(SpreadingAndInterpolation, a_uniform_velocity_is_sampled_exactly) {
    std::vector<double> velocity(3 * rows_.cells());
    const Vec3 uniform{0.3, -0.7, 1.1};
    for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = uniform[i % 3];
    std::vector<Vec3> at_markers(markers, Vec3{9, 9, 9});
    rows_.interpolate(velocity, at_markers);
    for (const Vec3& u : at_markers) {
        for (std::size_t d = 0; d < 3; ++d) {
            // Up to 64 weights that add up to one, each rounded.
            ASSERT_NEAR(u[d], uniform[d], 2e-14);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllKernels, SpreadingAndInterpolation,
                         ::testing::ValuesIn(all_kernels));

}  // namespace
}  // namespace magfsi::coupler
