#include "structure/mesh/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "structure/mesh/bounds.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/mesh_check.h"
#include "structure/mesh/surface.h"
#include "structure/mesh/surface_points.h"

namespace magfsi::structure {
namespace {

Bounds element_bounds(const Mesh& mesh) {
    Bounds out;
    for (const Hexahedron& element : mesh.elements) {
        for (const int node : element) out.add(mesh.nodes[node]);
    }
    return out;
}

// Points of a body inside a box: nodes, element centres, surface points.
std::vector<Vec3> samples(const Mesh& mesh, const Bounds& box, double spacing_m) {
    std::vector<Vec3> out;
    const auto keep = [&](const Vec3& x) {
        if (box.holds(x)) out.push_back(x);
    };
    for (const Hexahedron& element : mesh.elements) {
        Vec3 centre{};
        for (const int node : element) {
            keep(mesh.nodes[node]);
            for (int d = 0; d < 3; ++d) centre[d] += 0.125 * mesh.nodes[node][d];
        }
        keep(centre);
    }
    std::vector<SurfaceQuad> near;
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        if (bounds(mesh.nodes, quad.node).meets(box)) near.push_back(quad);
    }
    for (const SurfacePoint& point : surface_points(mesh, near, spacing_m)) {
        keep(position(mesh, point.point));
    }
    return out;
}

// By element: which of its faces are outer ones.
std::vector<std::array<bool, 6>> outer_faces(const Mesh& mesh) {
    std::vector<std::array<bool, 6>> outer(mesh.elements.size());
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        outer[quad.element][quad.face] = true;
    }
    return outer;
}

// Whether the point lies on an outer face of its element: the weights of the opposite
// corners are its distance to the face, as a share of the element.
bool on_outer_face(const MaterialPoint& point, const std::array<bool, 6>& outer) {
    for (int f = 0; f < 6; ++f) {
        double away = 0;
        for (const int corner : face_corners(f ^ 1)) away += point.weight[corner];
        if (outer[f] && away < 1e-6) return true;
    }
    return false;
}

std::optional<Overlap> first_inside(std::span<const Vec3> points, const Mesh& mesh,
                                    double touching_m) {
    const PointLocator locator(mesh);
    const auto outer = outer_faces(mesh);
    for (const Vec3& x : points) {
        const auto found = locator.find(x);
        // Most points of bodies that touch end here, before the long way below.
        if (!found || on_outer_face(*found, outer[found->element])) continue;
        const Vec3 wall = position(mesh, locator.nearest_on_surface(x));
        const double depth = std::hypot(wall[0] - x[0], wall[1] - x[1], wall[2] - x[2]);
        if (depth > touching_m) return Overlap{x, depth, 0, found->element};
    }
    return std::nullopt;
}

}  // namespace

std::optional<Overlap> bodies_overlap(const Mesh& a, const Mesh& b) {
    const Bounds box_a = element_bounds(a), box_b = element_bounds(b);
    if (!box_a.meets(box_b)) return std::nullopt;
    const double edge_a = shortest_edge_m(a), edge_b = shortest_edge_m(b);
    const double touching_m = 1e-6 * std::min(edge_a, edge_b);
    auto found = first_inside(samples(a, box_b, 0.5 * edge_b), b, touching_m);
    if (found) return found;
    found = first_inside(samples(b, box_a, 0.5 * edge_a), a, touching_m);
    if (found) found->of_body = 1;
    return found;
}

}  // namespace magfsi::structure
