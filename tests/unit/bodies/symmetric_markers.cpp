// SPDX-License-Identifier: GPL-2.0-or-later
// Markers of forcing no_slip have every mirror and quarter turn of their mesh, to
// rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/solvers/bodies/marker_placement.h"
#include "structure/mesh/block_mesh.h"
#include "structure/mesh/swept_mesh.h"

namespace magfsi::bodies {
namespace {

using structure::Mesh;
constexpr double grid_m = 1e-4;

// By default a mesh from a file, around the middle of its box.
std::vector<PlacedMarker> markers_of(
    const Mesh& mesh, const decltype(scene::Body::mesh)& from = structure::MeshFile{}) {
    scene::Scene scene;
    scene.fluid.emplace().spacing_m = grid_m;
    scene.fluid->box_m = {1e-2, 1e-2, 1e-2};
    scene.coupling.emplace().immersed_boundary.forcing = coupler::Forcing::no_slip;
    scene::Body& body = scene.bodies.emplace_back();
    body.name = "body";
    body.mesh = from;
    body.initial.position_m = {5e-3, 5e-3, 5e-3};
    return place_markers(scene, 0, mesh);
}

// A block without the elements for which `out` holds at their centre.
template <class Out>
Mesh block_without(const structure::Box& box, const Out& out) {
    Mesh mesh = structure::box_mesh(box);
    for (Vec3& x : mesh.nodes) x -= 0.5 * box.size_m;
    std::vector<structure::Hexahedron> kept;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        if (!out(structure::element_centre(mesh, e))) kept.push_back(mesh.elements[e]);
    mesh.elements = std::move(kept);
    // Nodes of no element go.
    std::vector<int> number(mesh.nodes.size(), -1);
    std::vector<Vec3> nodes;
    for (auto& element : mesh.elements)
        for (int& node : element) {
            if (number[node] < 0) {
                number[node] = static_cast<int>(nodes.size());
                nodes.push_back(mesh.nodes[node]);
            }
            node = number[node];
        }
    mesh.nodes = std::move(nodes);
    mesh.faces.clear();
    mesh.centre_line.clear();
    return mesh;
}

Mesh plus(double thickness_m, int layers) {
    return block_without(
        {{2.8e-3, 2.8e-3, thickness_m}, {14, 14, layers}},
        [](const Vec3& at) { return std::min(std::abs(at[0]), std::abs(at[1])) > 4e-4; });
}

// A cube whose shells become spheres.
Mesh ball(double radius_m) {
    Mesh mesh = block_without({{2 * radius_m, 2 * radius_m, 2 * radius_m}, {6, 6, 6}},
                              [](const Vec3&) { return false; });
    for (Vec3& x : mesh.nodes) {
        const double shell = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
        if (shell > 0) x *= shell / norm(x);
    }
    return mesh;
}

// Volume and length of the vector area of the marker at this place; none if there is
// none.
struct Found {
    double volume_m3 = 0, area_m2 = 0;
    int count = 0;
};
double area_m2(const PlacedMarker& marker, const Mesh& mesh) {
    Vec3 first{}, second{};
    for (std::size_t a = 0; a < 8; ++a) {
        first += marker.first_edge[a] * mesh.nodes[marker.point.node[a]];
        second += marker.second_edge[a] * mesh.nodes[marker.point.node[a]];
    }
    return norm(cross(first, second));
}
Found at(const std::vector<PlacedMarker>& markers, const Mesh& mesh, const Vec3& x) {
    Found found;
    for (const PlacedMarker& m : markers) {
        if (norm(structure::position(mesh, m.point) - x) > 1e-9 * grid_m) continue;
        found.volume_m3 += m.volume_m3;
        found.area_m2 += area_m2(m, mesh);
        ++found.count;
    }
    return found;
}

template <class Image>
void expect_same(const Mesh& mesh, const std::vector<PlacedMarker>& markers,
                 const Image& image) {
    for (const PlacedMarker& m : markers) {
        const Vec3 x = structure::position(mesh, m.point);
        const Found here = at(markers, mesh, x), there = at(markers, mesh, image(x));
        ASSERT_GT(there.count, 0)
            << "no image of (" << x[0] << ", " << x[1] << ", " << x[2] << ")";
        EXPECT_NEAR(there.volume_m3, here.volume_m3, 1e-9 * here.volume_m3);
        EXPECT_NEAR(there.area_m2, here.area_m2, 1e-9 * grid_m * grid_m);
    }
}

Vec3 mirror(const Vec3& x, std::size_t axis) {
    Vec3 image = x;
    image[axis] = -x[axis];
    return image;
}
Vec3 turned(const Vec3& x) {
    return {-x[1], x[0], x[2]};
}
Vec3 turned_about_y(const Vec3& x) {
    return {-x[2], x[1], x[0]};
}

TEST(SymmetricMarkers, of_a_plus_that_is_a_sheet) {
    for (const auto& [thickness_m, layers] :
         {std::pair{0.8e-4, 1}, {2e-4, 1}, {2e-4, 2}, {4.2e-4, 2}, {4.2e-4, 3}}) {
        const Mesh mesh = plus(thickness_m, layers);
        const auto markers = markers_of(mesh);
        for (std::size_t axis = 0; axis < 3; ++axis)
            expect_same(mesh, markers, [&](const Vec3& x) { return mirror(x, axis); });
        expect_same(mesh, markers, turned);
    }
}

TEST(SymmetricMarkers, of_a_ball) {
    for (const double cells : {3.0, 4.0, 4.5, 4.96, 6.0}) {
        const Mesh mesh = ball(cells * grid_m);
        const auto markers = markers_of(mesh);
        for (std::size_t axis = 0; axis < 3; ++axis)
            expect_same(mesh, markers, [&](const Vec3& x) { return mirror(x, axis); });
        expect_same(mesh, markers, turned);
        expect_same(mesh, markers, turned_about_y);
        // As far apart as they shall be, and no large hole between them.
        for (const PlacedMarker& m : markers)
            for (const PlacedMarker& other : markers) {
                const double apart_m = norm(structure::position(mesh, m.point) -
                                            structure::position(mesh, other.point));
                if (apart_m > 1e-9 * grid_m) {
                    EXPECT_GT(apart_m, 0.999 * grid_m);
                }
            }
    }
}

TEST(SymmetricMarkers, of_a_ring) {
    for (const double radius_m : {1e-3, 1.13e-3, 1.31e-3}) {
        const structure::Arc ring{
            radius_m, 2 * std::numbers::pi, {2.3e-4, 2.1e-4}, {16, 2, 2}};
        const Mesh mesh = structure::arc_mesh(ring);
        const auto markers = markers_of(mesh, ring);
        for (std::size_t axis = 0; axis < 3; ++axis)
            expect_same(mesh, markers, [&](const Vec3& x) { return mirror(x, axis); });
        expect_same(mesh, markers, turned_about_y);
    }
}

// Blocks have rows of markers; a cube keeps its quarter turns about every axis, a square
// bar about its own, with one and with several layers.
TEST(SymmetricMarkers, of_a_cube_and_a_square_bar) {
    for (const double cells : {1.3, 2.0, 2.7, 3.4, 5.0, 8.0}) {
        const double a = cells * grid_m;
        for (const double length_m : {a, 3.3 * a}) {
            const structure::Box box{{a, a, length_m}, {3, 3, length_m > a ? 5 : 3}};
            Mesh mesh = structure::box_mesh(box);
            for (Vec3& x : mesh.nodes) x -= 0.5 * box.size_m;
            const auto markers = markers_of(mesh, box);
            for (std::size_t axis = 0; axis < 3; ++axis)
                expect_same(mesh, markers,
                            [&](const Vec3& x) { return mirror(x, axis); });
            expect_same(mesh, markers, turned);
            if (length_m == a) expect_same(mesh, markers, turned_about_y);
        }
    }
}

// A block that lacks a corner has no symmetry left but one mirror.
TEST(SymmetricMarkers, keep_the_one_mirror_of_an_odd_body) {
    const Mesh mesh =
        block_without({{1e-3, 1e-3, 1.2e-3}, {5, 5, 6}},
                      [](const Vec3& at) { return at[0] > 0.2e-3 && at[1] > 0.2e-3; });
    const auto markers = markers_of(mesh);
    expect_same(mesh, markers, [](const Vec3& x) { return mirror(x, 2); });
    expect_same(mesh, markers, [](const Vec3& x) { return Vec3{x[1], x[0], x[2]}; });
}

}  // namespace
}  // namespace magfsi::bodies
