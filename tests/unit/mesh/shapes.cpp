// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of cubes, and blocks bent along curves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "structure/lattice/hexahedron.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/mesh_check.h"
#include "structure/mesh/surface.h"
#include "structure/mesh/swept_mesh.h"
#include "structure/mesh/voxel_mesh.h"

namespace magfsi::structure {
namespace {

constexpr double pi = std::numbers::pi;

// An L of three cubes in a grid that is wider than it.
TEST(VoxelMesh, HasTheFilledCubesInTheGridsFrame) {
    std::vector<char> filled(4 * 2 * 2);
    filled[1] = filled[2] = filled[1 + 4] = 1;  // (1, 0, 0), (2, 0, 0), (1, 1, 0)
    const Mesh mesh = voxel_mesh({4, 2, 2}, 0.5e-3, filled);
    EXPECT_EQ(mesh.elements.size(), 3U);
    EXPECT_EQ(mesh.nodes.size(), 16U);
    EXPECT_NEAR(volume_m3(mesh), 3 * 0.125e-9, 1e-22);
    const Bounds all = bounds(mesh.nodes);
    EXPECT_EQ(all.low_m, (Vec3{0.5e-3, 0, 0}));
    EXPECT_NEAR(all.high_m[0], 1.5e-3, 1e-18);
    EXPECT_NEAR(all.high_m[2], 0.5e-3, 1e-18);
    EXPECT_EQ(mesh.faces.at("x_max").size(), 4U);
    EXPECT_EQ(mesh.faces.at("y_max").size(), 4U);
    EXPECT_EQ(mesh.faces.at("z_max").size(), 8U);
}

TEST(VoxelMesh, ABlockIsTheBoxMesh) {
    const Mesh block = box_mesh({{1.5e-3, 1e-3, 0.5e-3}, {3, 2, 1}});
    const Mesh mesh = voxel_mesh({3, 2, 1}, 0.5e-3, std::vector<char>(6, 1));
    EXPECT_EQ(mesh.elements, block.elements);
    EXPECT_EQ(mesh.faces, block.faces);
    for (std::size_t a = 0; a < block.nodes.size(); ++a)
        EXPECT_LT(distance_m(mesh.nodes[a], block.nodes[a]), 1e-18);
}

TEST(VoxelMesh, NothingAndPartsAreRefused) {
    EXPECT_THROW(voxel_mesh({3, 1, 1}, 1, {0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(voxel_mesh({3, 1, 1}, 1, {1, 0, 1}), std::invalid_argument);
    // Joined along an edge, at a corner.
    EXPECT_THROW(voxel_mesh({2, 2, 1}, 1, {1, 0, 0, 1}), std::invalid_argument);
    EXPECT_THROW(voxel_mesh({2, 2, 2}, 1, {1, 0, 0, 0, 0, 0, 0, 1}),
                 std::invalid_argument);
}

TEST(VoxelMesh, ACrumbIsLeftOut) {
    std::vector<char> filled(12 * 12 * 2);
    for (std::size_t i = 0; i < 12 * 12; ++i) filled[i] = i % 12 < 11 && i / 12 < 11;
    filled[12 * 11 + 11] = 1;  // hangs on the corner of the other 121
    const Mesh mesh = voxel_mesh({12, 12, 2}, 1, filled);
    EXPECT_EQ(mesh.elements.size(), 121U);
    EXPECT_EQ(bounds(mesh.nodes).high_m, (Vec3{11, 11, 1}));
}

double least_volume_m3(const Mesh& mesh) {
    double least = INFINITY;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        least = std::min(least, integrate_hexahedron(gather(mesh.nodes, mesh.elements[e]),
                                                     static_cast<int>(e))
                                    .volume);
    return least;  // an inverted element throws
}

// By Pappus' theorem a body swept by a section whose middle is on the curve has the
// volume of the block; hexahedra along chords lack a share of the square of the angle.
TEST(ArcMesh, VolumeComesToThatOfTheBlockWithOrderTwo) {
    double before = 0;
    for (const int n : {16, 32, 64}) {
        const Mesh mesh = arc_mesh({2e-3, 1.5 * pi, {1e-3, 0.4e-3}, {n, 2, 2}});
        EXPECT_GT(least_volume_m3(mesh), 0);
        const double error = 1 - volume_m3(mesh) / (2e-3 * 1.5 * pi * 0.4e-6);
        if (before > 0) {
            EXPECT_NEAR(before / error, 4, 0.05);
        }
        before = error;
    }
}

TEST(ArcMesh, IsABlockWhoseEndsAreBentUp) {
    const Mesh mesh = arc_mesh({2e-3, pi, {1e-3, 0.4e-3}, {16, 1, 1}});
    ASSERT_EQ(mesh.centre_line.size(), 17U);
    for (const auto& [point, x, z] :
         {std::tuple(0, -2e-3, 0.0), std::tuple(8, 0.0, -2e-3),
          std::tuple(16, 2e-3, 0.0)}) {
        const Vec3 at = position(mesh, mesh.centre_line[static_cast<std::size_t>(point)]);
        EXPECT_NEAR(at[0], x, 1e-16);
        EXPECT_NEAR(at[1], 0, 1e-16);
        EXPECT_NEAR(at[2], z, 1e-16);
    }
    // The upper face is the one towards the centre.
    for (const int node : mesh.faces.at("z_max"))
        EXPECT_NEAR(std::hypot(mesh.nodes[node][0], mesh.nodes[node][2]), 1.8e-3, 1e-16);
    EXPECT_EQ(mesh.elements,
              box_mesh(straightened(Arc{2e-3, pi, {1e-3, 0.4e-3}, {16, 1, 1}})).elements);
}

TEST(ArcMesh, ARingHasNoEnds) {
    const Mesh mesh = arc_mesh({2e-3, 2 * pi, {1e-3, 0.4e-3}, {24, 2, 1}});
    EXPECT_EQ(mesh.nodes.size(), 24U * 3 * 2);
    EXPECT_EQ(mesh.elements.size(), 48U);
    EXPECT_FALSE(mesh.faces.contains("x_min"));
    EXPECT_EQ(mesh.faces.at("z_min").size(), 24U * 3);
    EXPECT_EQ(boundary_quads(mesh).size(), 2U * (24 * 2 + 24));
    EXPECT_GT(least_volume_m3(mesh), 0);
    EXPECT_FALSE(coincident_nodes(mesh, 1e-9));
    for (const auto& [name, nodes] : mesh.faces) {
        const double side = name[0] == 'y' ? 0.5e-3 : name == "z_min" ? 2.2e-3 : 1.8e-3;
        for (const int node : nodes) {
            const Vec3& x = mesh.nodes[static_cast<std::size_t>(node)];
            EXPECT_NEAR(name[0] == 'y' ? std::abs(x[1]) : std::hypot(x[0], x[2]), side,
                        1e-16)
                << name;
        }
    }
}

TEST(HelixMesh, VolumeComesToThatOfTheBlockWithOrderTwo) {
    for (const bool left : {false, true}) {
        double before = 0;
        for (const int n : {48, 96, 192}) {
            const Helix helix{0.5e-3, 2e-3, 3, {0.3e-3, 0.2e-3}, {n, 2, 2}, left};
            const Mesh mesh = helix_mesh(helix);
            EXPECT_GT(least_volume_m3(mesh), 0);
            const double whole = 3 * std::hypot(pi * 1e-3, 2e-3) * 0.06e-6;
            const double error = 1 - volume_m3(mesh) / whole;
            if (before > 0) {
                EXPECT_NEAR(before / error, 4, 0.1);
            }
            before = error;
        }
    }
}

TEST(HelixMesh, TurnsWithItsHand) {
    for (const bool left : {false, true}) {
        const Mesh mesh =
            helix_mesh({0.5e-3, 2e-3, 1, {0.1e-3, 0.1e-3}, {32, 1, 1}, left});
        const Vec3 start = position(mesh, mesh.centre_line[0]);
        const Vec3 quarter = position(mesh, mesh.centre_line[8]);
        EXPECT_NEAR(start[1], 0.5e-3, 1e-16);
        EXPECT_NEAR(quarter[0], 0.5e-3, 1e-16);
        EXPECT_NEAR(quarter[2], left ? -0.5e-3 : 0.5e-3, 1e-16);
    }
}

TEST(SweptMesh, WhatWouldPassThroughItselfIsRefused) {
    EXPECT_THROW(arc_mesh({0.2e-3, pi, {1e-3, 0.4e-3}, {16, 1, 1}}),
                 std::invalid_argument);
    EXPECT_THROW(arc_mesh({2e-3, 2 * pi, {1e-3, 0.4e-3}, {7, 1, 1}}),
                 std::invalid_argument);
    EXPECT_THROW(helix_mesh({0.5e-3, 0.3e-3, 3, {0.3e-3, 0.2e-3}, {48, 1, 1}}),
                 std::invalid_argument);
    EXPECT_THROW(helix_mesh({0.1e-3, 0.1e-3, 0.5, {0.1e-3, 0.3e-3}, {48, 1, 1}}),
                 std::invalid_argument);
    EXPECT_THROW(helix_mesh({0, 0.1e-3, 0.5, {0.1e-3, 0.1e-3}, {48, 1, 1}}),
                 std::invalid_argument);
}

// At the middle of an element of even points the tangent is exact: the chord's.
TEST(CurveMagnetization, FollowsARing) {
    const Mesh mesh = arc_mesh({2e-3, 2 * pi, {1e-3, 0.4e-3}, {24, 1, 1}});
    const auto m = curve_magnetization(mesh, {7, {}, 0, 0, {0, 2}});
    for (std::size_t e = 0; e < m.size(); ++e) {
        const double angle = (static_cast<double>(e) + 0.5) / 24 * 2 * pi - pi;
        EXPECT_NEAR(m[e][0], 7 * std::cos(angle), 1e-12);
        EXPECT_NEAR(m[e][1], 0, 1e-12);
        EXPECT_NEAR(m[e][2], 7 * std::sin(angle), 1e-12);
    }
}

TEST(CurveMagnetization, OnABlockIsTheHarmonicOne) {
    const Mesh mesh = box_mesh({{4e-3, 1e-3, 0.2e-3}, {16, 2, 1}});
    const auto curve = curve_magnetization(mesh, {7, {}, 4e-3, 0.3, {0, 2}});
    const auto wave = harmonic_magnetization(mesh, {7, 4e-3, 0.3, 0, 2});
    for (std::size_t e = 0; e < curve.size(); ++e)
        for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(curve[e][d], wave[e][d], 1e-12);
}

TEST(CurveMagnetization, HasTheLengthAlongAHelix) {
    const Helix helix{0.5e-3, 2e-3, 3, {0.1e-3, 0.1e-3}, {240, 1, 1}};
    const Mesh mesh = helix_mesh(helix);
    const auto m = curve_magnetization(mesh, {1, {}, 0, 0, {0, 2}});
    const double slope = std::hypot(2e-3, 1e-3 * pi);
    for (std::size_t e = 0; e < m.size(); ++e) {
        const double t = 2 * pi * 3 * (static_cast<double>(e) + 0.5) / 240;
        // Chords of a fortieth of a radian or so.
        EXPECT_NEAR(m[e][0], 2e-3 / slope, 1e-3);
        EXPECT_NEAR(m[e][1], -1e-3 * pi / slope * std::sin(t), 1e-3);
        EXPECT_NEAR(m[e][2], 1e-3 * pi / slope * std::cos(t), 1e-3);
    }
}

TEST(CurveMagnetization, NeedsACurve) {
    Mesh mesh = box_mesh({{4e-3, 1e-3, 0.2e-3}, {4, 1, 1}});
    mesh.centre_line.clear();
    EXPECT_THROW(curve_magnetization(mesh, {1, {}, 0, 0, {0, 2}}), std::invalid_argument);
    const CurveMagnetization doubled{1, {{0, 0, 0}, {0, 0, 0}}, 0, 0, {0, 2}};
    EXPECT_THROW(curve_magnetization(mesh, doubled), std::invalid_argument);
    const auto m = curve_magnetization(mesh, {2, {{0, 0, 0}, {0, 1, 0}}, 0, 0, {0, 2}});
    EXPECT_EQ(m[3], (Vec3{0, 2, 0}));
}

TEST(RadialMagnetization, PointsAwayFromThePointOrTheAxis) {
    const Mesh mesh = box_mesh({{2e-3, 2e-3, 2e-3}, {2, 2, 2}});
    const double third = 1 / std::sqrt(3.0), half = 1 / std::sqrt(2.0);
    const auto ball = radial_magnetization(mesh, {3, {1e-3, 1e-3, 1e-3}, {}});
    const auto rod = radial_magnetization(mesh, {-3, {1e-3, 1e-3, 1e-3}, Vec3{0, 0, 5}});
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_NEAR(ball[0][d], -3 * third, 1e-12);
        EXPECT_NEAR(rod[7][d], d == 2 ? 0 : -3 * half, 1e-12);
    }
    EXPECT_THROW(radial_magnetization(mesh, {3, {0.5e-3, 0.5e-3, 0}, Vec3{0, 0, 1}}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
