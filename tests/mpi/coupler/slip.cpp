// SPDX-License-Identifier: GPL-2.0-or-later
// No-slip error and leakage of markers whose slip is known, the same cube on every rank.
#include "coupler/immersed_boundary/slip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coupler/step/report.h"

namespace magfsi::coupler {
namespace {

// The unit cube, one marker in the middle of each of its six faces.
struct Cube {
    std::vector<double> x, v;
    std::vector<Marker> markers;
    std::vector<MarkerArea> areas;

    Cube() {
        for (int a = 0; a < 8; ++a)
            for (int d = 0; d < 3; ++d) x.push_back((a >> d) & 1);
        v.assign(24, 0.0);
        for (int face = 0; face < 6; ++face) {
            const int d = face / 2;
            const int high = face % 2;
            Marker m;
            MarkerArea area;
            area.marker = face;
            for (int a = 0; a < 8; ++a) {
                const auto at = static_cast<std::size_t>(a);
                m.node[at] = a;
                m.weight[at] = ((a >> d) & 1) == high ? 0.25 : 0;
                // Mean slopes along the two other axes, in the order that points
                // outwards.
                const int e = (d + (high ? 1 : 2)) % 3;
                const int f = (d + (high ? 2 : 1)) % 3;
                area.first[at] = ((a >> e) & 1) ? 0.25 : -0.25;
                area.second[at] = ((a >> f) & 1) ? 0.25 : -0.25;
            }
            markers.push_back(m);
            areas.push_back(area);
        }
    }

    // Of the markers.
    std::vector<Vec3> velocities() const {
        std::vector<Vec3> all;
        for (const Marker& m : markers) all.push_back(at_marker(m, v.data()));
        return all;
    }
};

int ranks() {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

TEST(Slip, areas_follow_the_deformation) {
    Cube cube;
    // A sheared, stretched and turned cube: the edges at its origin.
    const Vec3 edge[] = {{1.2, -0.4, 0.3}, {0.5, 0.9, 0}, {-0.1, 0.2, 1.1}};
    std::vector<double> moved(24);
    for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t e = 0; e < 3; ++e)
            for (std::size_t d = 0; d < 3; ++d)
                moved[3 * a + d] += cube.x[3 * a + e] * edge[e][d];
    for (std::size_t face = 0; face < 6; ++face) {
        const Vec3& e = edge[(face / 2 + 1) % 3];
        const Vec3& f = edge[(face / 2 + 2) % 3];
        const double sign = face % 2 ? 1 : -1;
        const Vec3 found =
            area_vector(cube.markers[face], cube.areas[face], moved.data());
        for (std::size_t d = 0; d < 3; ++d) {
            const std::size_t i = (d + 1) % 3, j = (d + 2) % 3;
            EXPECT_NEAR(found[d], sign * (e[i] * f[j] - e[j] * f[i]), 1e-14) << face;
        }
    }
}

TEST(Slip, of_a_uniform_stream_through_a_body_at_rest) {
    Cube cube;
    SlipRecord record(cube.areas);
    const std::vector<Vec3> stream(6, Vec3{0.3, 0, 0.4});
    record.add(cube.markers, stream, cube.velocities(), cube.x.data());
    const SlipReport slip = record.collect(MPI_COMM_WORLD);
    EXPECT_EQ(slip.markers, 6 * ranks());
    EXPECT_DOUBLE_EQ(slip.error_m_s, 0.5);
    EXPECT_EQ(slip.marker_speed_m_s, 0);
    EXPECT_DOUBLE_EQ(slip.surface_m2, 6 * ranks());
    EXPECT_DOUBLE_EQ(slip.leakage_m3_s,
                     0.7 * ranks());  // in through two faces, out through two
}

TEST(Slip, none_where_the_fluid_moves_with_the_body) {
    Cube cube;
    for (std::size_t a = 0; a < 8; ++a) cube.v[3 * a + 1] = 0.2;
    SlipRecord record(cube.areas);
    record.add(cube.markers, std::vector<Vec3>(6, Vec3{0, 0.2, 0}), cube.velocities(),
               cube.x.data());
    const SlipReport slip = record.collect(MPI_COMM_WORLD);
    EXPECT_EQ(slip.error_m_s, 0);
    EXPECT_EQ(slip.leakage_m3_s, 0);
    EXPECT_DOUBLE_EQ(slip.marker_speed_m_s, 0.2);
}

TEST(Slip, is_a_mean_over_samples_and_knows_the_worst) {
    Cube cube;
    SlipRecord record(cube.areas);
    for (const double u : {0.1, 0.7}) {
        record.add(cube.markers, std::vector<Vec3>(6, Vec3{u, 0, 0}), cube.velocities(),
                   cube.x.data());
    }
    const SlipReport slip = record.collect(MPI_COMM_WORLD);
    EXPECT_EQ(slip.samples, 2);
    EXPECT_DOUBLE_EQ(slip.error_m_s, 0.5);  // (0.1^2 + 0.7^2) / 2 = 0.5^2
    EXPECT_DOUBLE_EQ(slip.largest_error_m_s, 0.7);
    EXPECT_DOUBLE_EQ(slip.leakage_m3_s, 0.4 * ranks());
}

TEST(Slip, is_relative_to_the_faster_of_body_and_stream) {
    constexpr double stream_m_s = 0.5;
    SlipReport slip{6, 1, 0.05, 0.05, 0.2, 0.3, 6};
    EXPECT_DOUBLE_EQ(boundary_summary(slip, stream_m_s).error, 0.1);
    EXPECT_DOUBLE_EQ(boundary_summary(slip, stream_m_s).leakage, 0.3 / (0.5 * 6 / 4));
    slip.marker_speed_m_s = 1;
    EXPECT_DOUBLE_EQ(boundary_summary(slip, stream_m_s).error, 0.05);
    // Nothing moves: no scale, and no slip either.
    EXPECT_EQ(boundary_summary(SlipReport{}, 0).error, 0);
}

// Forcing no_slip is advised only where it is not in force, and can be.
TEST(BoundaryReport, AdvisesWhatCanBeFollowed) {
    output::BoundarySummary boundary;
    boundary.error = 0.06;
    EXPECT_NE(to_text(boundary, true).find("forcing: no_slip, or compare"),
              std::string::npos);
    const std::string held = to_text(boundary, false);
    EXPECT_EQ(held.find("forcing: no_slip"), std::string::npos) << held;
    EXPECT_NE(held.find("compare with a run of half the time.step"), std::string::npos);
    boundary.error = 0.04;
    EXPECT_EQ(to_text(boundary, true).find("warning"), std::string::npos);
}

}  // namespace
}  // namespace magfsi::coupler
