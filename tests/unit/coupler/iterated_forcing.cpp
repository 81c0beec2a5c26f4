// Iterated forcing takes the slip away, and what the fluid is given the body pays.
#include "coupler/immersed_boundary/iterated_forcing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/immersed_boundary/fluid_side.h"
#include "tests/mpi/coupler/array_fluid.h"
#include "tests/unit/coupler/random_markers.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

// A sheet across z through a periodic box: markers half a cell apart, each moving its
// area times one spacing.
struct SheetOfMarkers {
    Grid grid = cut_grid({8, 8, 12}, {true, true, true});
    double h = grid.spacing_m;
    std::vector<Marker> markers;
    std::vector<Vec3> points_m;

    SheetOfMarkers() {
        for (int i = 0; i < 16; ++i) {
            for (int j = 0; j < 16; ++j) {
                points_m.push_back({(0.5 * i + 0.1) * h, (0.5 * j + 0.2) * h, 5.3 * h});
                Marker m;
                m.volume_m3 = h * h * h / 4;
                markers.push_back(m);
            }
        }
    }
};

// The sum of the squares of a kernel's values is the same wherever a marker sits: what a
// sheet gives, smeared across it, returns to it by that share.
double share(Kernel kernel) {
    const Stencil1D s = stencil_1d(kernel, 5.3);
    double sum = 0;
    for (const double w : s.weight) sum += w * w;
    return sum;
}

TEST(IteratedForcing, each_iteration_leaves_of_a_sheets_slip_what_the_kernel_smears) {
    EXPECT_NEAR(share(Kernel::three_point), 1.0 / 2, 1e-15);  // by construction of the
    EXPECT_NEAR(share(Kernel::four_point), 3.0 / 8, 1e-15);   // kernels
    for (const Kernel kernel : {Kernel::three_point, Kernel::four_point}) {
        SheetOfMarkers sheet;
        ArrayFluid fluid(sheet.grid, 0);
        FluidSide side(fluid, sheet.grid.owned_by_rank[0], kernel, ArrayFluid::step_s);
        IteratedForcing forcing(sheet.markers,
                                {1, ArrayFluid::density_kg_m3, ArrayFluid::step_s});
        // It moves by 0.3 m/s along z through the fluid around it.
        std::vector<Vec3> now_m = sheet.points_m;
        const auto still = side.sample(sheet.points_m);
        for (std::size_t m = 0; m < now_m.size(); ++m) {
            for (std::size_t d = 0; d < 3; ++d)
                now_m[m][d] += ArrayFluid::step_s * (still[m][d] + (d == 2 ? 0.3 : 0.0));
        }
        const std::vector<Vec3> none(now_m.size());
        side.spread(sheet.points_m, none);
        double slip = 0.3;
        const double mass_kg = 2 * ArrayFluid::density_kg_m3 * std::pow(sheet.h, 3) / 4;
        for (int i = 0; i < 4; ++i) {
            const auto given = forcing.correct(
                sheet.points_m, now_m,
                side.sample_forced(sheet.points_m, ArrayFluid::density_kg_m3));
            for (const Vec3& j : given) {
                // Roundings of positions over a step of 2e-5 s.
                EXPECT_NEAR(j[2] / mass_kg, slip, 1e-12);
                EXPECT_NEAR(j[0] / mass_kg, 0, 1e-12);
            }
            side.spread_more(given);
            slip *= 1 - share(kernel);
        }
    }
}

TEST(IteratedForcing, adds_up_what_was_given_and_forgets_it) {
    const Marker marker;
    const std::vector<Marker> one(1, marker);
    std::vector<Marker> markers = one;
    markers[0].volume_m3 = 1e-12;
    IteratedForcing forcing(markers, {1, 1000, 2e-5});
    const std::vector<Vec3> before{{0, 0, 0}}, now{{2e-6, 0, 0}};  // 0.1 m/s
    forcing.correct(before, now, std::vector<Vec3>{{0.04, 0, 0}});
    forcing.correct(before, now, std::vector<Vec3>{{0.09, 0, 0}});
    EXPECT_NEAR(forcing.impulse()[0][0], 2e-9 * (0.06 + 0.01), 1e-22);
    forcing.begin_step();
    EXPECT_EQ(forcing.impulse()[0], (Vec3{}));
}

// A held force may not exceed the drag of the substeps, which a strength below 1 weakens.
TEST(IteratedForcing, takes_no_more_of_the_slip_than_the_strength_says) {
    std::vector<Marker> markers(1);
    markers[0].volume_m3 = 1e-12;
    const std::vector<Vec3> before{{0, 0, 0}}, now{{2e-6, 0, 0}};  // 0.1 m/s
    for (const auto& [strength, share] :
         std::vector<std::pair<double, double>>{{0.25, 0.25}, {1, 1}, {2, 1}}) {
        IteratedForcing forcing(markers, {strength, 1000, 2e-5});
        const auto given = forcing.correct(before, now, std::vector<Vec3>{{0.04, 0, 0}});
        EXPECT_NEAR(given[0][0], share * 2e-9 * 0.06, 1e-22) << strength;
    }
}

TEST(IteratedForcing, the_body_pays_all_of_it_in_the_next_step) {
    Random random(4);
    constexpr std::size_t count = 30;
    PenaltyForce penalty(random_markers(random, count), {0.75, 1000, 2e-5}, {});
    const auto owed = random.vectors(count, 1e-9);
    penalty.begin_step(random.vectors(count, 0.5), owed);
    Vec3 lost{}, given{};
    for (int i = 0; i < 4; ++i) {
        std::vector<double> force(3 * nodes);
        penalty.apply(random_nodal(random).data(), force.data(), 5e-6);
        for (std::size_t n = 0; n < force.size(); ++n) lost[n % 3] -= 5e-6 * force[n];
    }
    for (std::size_t m = 0; m < count; ++m)
        for (std::size_t d = 0; d < 3; ++d)
            given[d] += penalty.impulse()[m][d] + owed[m][d];
    // The enclosed fluid has no part: these markers displace nothing.
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(lost[d], given[d], 1e-13 * 3e-8);
}

}  // namespace
}  // namespace magfsi::coupler
