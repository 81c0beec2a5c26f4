// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of round bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "structure/lattice/hexahedron.h"
#include "structure/lattice/stable_step.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/mesh_check.h"
#include "structure/mesh/round_mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {
namespace {

constexpr double pi = std::numbers::pi;

// A mesh that a solver takes: valid elements, one connected piece, a closed surface,
// whose nodes are those of the faces.
void expect_sound(const Mesh& mesh, double volume, bool faces_cover = true) {
    EXPECT_NO_THROW(refuse_broken_mesh(mesh));
    EXPECT_NEAR(volume_m3(mesh) / volume, 1, 1e-12);
    const auto part = parts_joined_by_faces(mesh);
    EXPECT_EQ(*std::ranges::max_element(part), 0);
    Vec3 sum{};
    std::set<int> outside;
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        sum += quad_area_vector(corners(mesh.nodes, quad.node));
        outside.insert(quad.node.begin(), quad.node.end());
    }
    EXPECT_LT(norm(sum), 1e-12 * std::cbrt(volume * volume));
    std::set<int> of_faces;
    for (const auto& [name, nodes] : mesh.faces)
        of_faces.insert(nodes.begin(), nodes.end());
    EXPECT_EQ(mesh.faces.size(), 6U);
    if (faces_cover) {
        EXPECT_EQ(of_faces, outside);
    }
}

// Smallest stable step of the elements over that of a cube of the mean volume: badly
// shaped elements would need far shorter steps.
double step_share(const Mesh& mesh) {
    Body body;
    body.mesh = mesh;
    body.material = {1e5, 4e5, 1000};
    const double edge =
        std::cbrt(volume_m3(mesh) / static_cast<double>(mesh.elements.size()));
    Body cube = body;
    Mesh one;
    for (int a = 0; a < 8; ++a)
        one.nodes.push_back({edge * (a & 1), edge * ((a >> 1) & 1), edge * (a >> 2)});
    one.elements = {{0, 1, 2, 3, 4, 5, 6, 7}};
    cube.mesh = one;
    return stable_step_s(body) / stable_step_s(cube);
}

TEST(RoundMesh, OfABallHasItsVolumeAndNoBadElement) {
    for (const std::array<int, 2> n : {std::array{1, 1}, {2, 1}, {4, 2}, {5, 3}}) {
        const Mesh mesh = ball_mesh({2e-3, n});
        expect_sound(mesh, 4.0 / 3 * pi * 1e-9);
        EXPECT_EQ(mesh.elements.size(),
                  static_cast<std::size_t>(n[0] * n[0] * (n[0] + 6 * n[1])));
        EXPECT_GT(step_share(mesh), 0.3) << n[0];
        for (const int node : mesh.faces.at("y_max"))
            EXPECT_NEAR(norm(mesh.nodes[node]),
                        norm(mesh.nodes[mesh.faces.at("x_min")[0]]), 1e-15);
    }
}

TEST(RoundMesh, OfACylinderHasItsVolumeAndEnds) {
    const Mesh mesh = cylinder_mesh({1e-3, 4e-3, {2, 2, 8}});
    expect_sound(mesh, pi * 0.25e-6 * 4e-3);
    EXPECT_EQ(mesh.elements.size(), (4U + 4 * 2 * 2) * 8);
    EXPECT_EQ(mesh.centre_line.size(), 9U);
    for (const int node : mesh.faces.at("x_min"))
        EXPECT_NEAR(mesh.nodes[node][0], -2e-3, 1e-15);
    const Bounds end = bounds(mesh.nodes, mesh.faces.at("x_max"));
    EXPECT_NEAR(end.low_m[0], 2e-3, 1e-15);
    EXPECT_LT(norm(position(mesh, mesh.centre_line[4])), 1e-15);
    EXPECT_GT(step_share(mesh), 0.3);
}

TEST(RoundMesh, OfACapsuleAndAConeHaveTheirVolumes) {
    const Mesh capsule = capsule_mesh({1e-3, 3e-3, {2, 2, 6}});
    expect_sound(capsule, pi * 0.25e-6 * (2e-3 + 4.0 / 3 * 0.5e-3));
    EXPECT_NEAR(bounds(capsule.nodes).extent_m()[0], 3e-3, 1e-15);
    EXPECT_EQ(capsule.elements.size(), (4U + 16) * 8 + 2 * 4 * 2);
    EXPECT_GT(step_share(capsule), 0.3);
    const Mesh cone = cone_mesh({{1e-3, 0.2e-3}, 2e-3, {2, 1, 10}});
    expect_sound(cone, pi / 3 * 2e-3 * (0.25e-6 + 0.05e-6 + 0.01e-6));
    EXPECT_GT(bounds(cone.nodes, cone.faces.at("x_min")).extent_m()[1],
              4 * bounds(cone.nodes, cone.faces.at("x_max")).extent_m()[1]);
}

TEST(RoundMesh, OfAWireIsWoundAsItSays) {
    const WireMesh wire{1e-3, 1.5e-3, 3, 0.4e-3, {1, 1, 60}, false, {}};
    const double length = 3 * std::hypot(2 * pi * 1e-3, 1.5e-3);
    const Mesh mesh = wire_mesh(wire);
    EXPECT_NO_THROW(refuse_broken_mesh(mesh));
    // Sections are joined by straight elements: 20 a turn.
    EXPECT_NEAR(volume_m3(mesh) / (pi * 0.04e-6 * length), 1, 1e-3);
    EXPECT_EQ(mesh.centre_line.size(), 61U);
    const Vec3 first = position(mesh, mesh.centre_line.front());
    EXPECT_LT(distance_m(first, {0, 1e-3, 0}), 2e-5);
    const Vec3 next = position(mesh, mesh.centre_line[5]);  // a quarter of a turn
    EXPECT_LT(distance_m(next, {1.5e-3 / 4, 0, 1e-3}), 4e-5);
    WireMesh left = wire;
    left.left_handed = true;
    EXPECT_LT(position(wire_mesh(left), mesh.centre_line[5])[2], -0.9e-3);
}

TEST(RoundMesh, OfAWireEndsInItsHead) {
    const WireMesh wire{1e-3, 1.5e-3, 2, 0.3e-3, {2, 1, 96}, false, WireHead{1e-3, 2e-3}};
    const Mesh mesh = wire_mesh(wire);
    EXPECT_NO_THROW(refuse_broken_mesh(mesh));
    const Bounds end = bounds(mesh.nodes, mesh.faces.at("x_max"));
    EXPECT_NEAR(end.extent_m()[1], 1e-3, 0.15e-3);
    EXPECT_NEAR(0.5 * (end.low_m[1] + end.high_m[1]), 0, 2e-5);
    EXPECT_NEAR(end.high_m[0], 3.5 * 1.5e-3 + 2e-3, 1e-5);
}

TEST(RoundMesh, RefusesWhatIsNone) {
    EXPECT_THROW(ball_mesh({0, {2, 1}}), std::invalid_argument);
    EXPECT_THROW(ball_mesh({1, {0, 1}}), std::invalid_argument);
    EXPECT_THROW(capsule_mesh({1, 1, {2, 1, 4}}), std::invalid_argument);
    EXPECT_THROW(capsule_mesh({1, 2, {3, 1, 4}}), std::invalid_argument);
    EXPECT_THROW(wire_mesh({1e-3, 1e-3, 2, 1.1e-3, {1, 1, 60}, false, {}}),
                 std::invalid_argument);
    EXPECT_THROW(wire_mesh({1e-3, 3e-3, 2, 0.2e-3, {1, 1, 10}, false, {}}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
