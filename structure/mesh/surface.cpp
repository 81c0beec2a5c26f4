#include "structure/mesh/surface.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace magfsi::structure {
namespace {

struct Face {
    std::array<int, 4> sorted;
    int element, face;
    auto key() const { return std::tie(sorted, element, face); }
};

std::vector<Face> sorted_faces(const Mesh& mesh) {
    std::vector<Face> faces;
    faces.reserve(6 * mesh.elements.size());
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        for (int f = 0; f < 6; ++f) {
            std::array<int, 4> node{};
            const auto corners = face_corners(f);
            for (int a = 0; a < 4; ++a) node[a] = mesh.elements[e][corners[a]];
            std::ranges::sort(node);
            faces.push_back({node, static_cast<int>(e), f});
        }
    }
    std::ranges::sort(faces,
                      [](const Face& a, const Face& b) { return a.key() < b.key(); });
    return faces;
}

[[noreturn]] void refuse_shared(const Face& a, const Face& b, const Face& c) {
    throw std::invalid_argument(
        fmt::format("elements {}, {} and {} share one face (nodes {} {} {} {}); a face "
                    "belongs to one element or to two",
                    a.element, b.element, c.element, a.sorted[0], a.sorted[1],
                    a.sorted[2], a.sorted[3]));
}

SurfaceQuad outward_quad(const Mesh& mesh, int element, int face) {
    SurfaceQuad quad{{}, element, face};
    const auto corners = face_corners(face);
    for (int a = 0; a < 4; ++a) quad.node[a] = mesh.elements[element][corners[a]];
    return quad;
}

Eigen::Vector3d at(const std::vector<Vec3>& nodes_m, int node) {
    return Eigen::Vector3d(nodes_m[node].data());
}

// Integrals of the four bilinear shape functions over the quad, 2x2 Gauss points: exact
// for plane parallelograms, and of fourth order in the edge for others.
std::array<double, 4> corner_areas(const std::vector<Vec3>& nodes_m,
                                   const SurfaceQuad& quad) {
    std::array<Eigen::Vector3d, 4> x;
    for (int a = 0; a < 4; ++a) x[a] = at(nodes_m, quad.node[a]);
    std::array<double, 4> areas{};
    const double q = 0.5 / std::sqrt(3.0);
    for (const double u : {0.5 - q, 0.5 + q}) {
        for (const double v : {0.5 - q, 0.5 + q}) {
            const Eigen::Vector3d along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
            const Eigen::Vector3d along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
            const double area = 0.25 * along_u.cross(along_v).norm();
            const std::array<double, 4> shape{(1 - u) * (1 - v), u * (1 - v), u * v,
                                              (1 - u) * v};
            for (int a = 0; a < 4; ++a) areas[a] += shape[a] * area;
        }
    }
    return areas;
}

}  // namespace

std::array<int, 4> face_corners(int face) {
    const int d = face / 2;
    const int u = 1 << ((d + 1) % 3);
    const int v = 1 << ((d + 2) % 3);
    const int base = (face % 2) << d;
    // u x v points along +d: outward on the high side, turned round on the low one.
    if (base == 0) return {base, base | v, base | u | v, base | u};
    return {base, base | u, base | u | v, base | v};
}

std::vector<std::array<FaceOfElement, 6>> face_neighbours(const Mesh& mesh) {
    const std::vector<Face> faces = sorted_faces(mesh);
    std::vector<std::array<FaceOfElement, 6>> behind(mesh.elements.size());
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i;
        while (end < faces.size() && faces[end].sorted == faces[i].sorted) ++end;
        if (end - i > 2) refuse_shared(faces[i], faces[i + 1], faces[i + 2]);
        if (end - i == 2) {
            const Face &a = faces[i], &b = faces[i + 1];
            behind[a.element][a.face] = {b.element, b.face};
            behind[b.element][b.face] = {a.element, a.face};
        }
        i = end;
    }
    return behind;
}

std::vector<SurfaceQuad> boundary_quads(const Mesh& mesh) {
    const auto behind = face_neighbours(mesh);
    std::vector<SurfaceQuad> surface;
    for (std::size_t e = 0; e < behind.size(); ++e) {
        for (int f = 0; f < 6; ++f) {
            if (behind[e][f].element >= 0) continue;
            surface.push_back(outward_quad(mesh, static_cast<int>(e), f));
        }
    }
    return surface;
}

double quad_area(const std::vector<Vec3>& nodes_m, const SurfaceQuad& quad) {
    const auto areas = corner_areas(nodes_m, quad);
    return areas[0] + areas[1] + areas[2] + areas[3];
}

Vec3 quad_area_vector(const std::vector<Vec3>& nodes_m, const SurfaceQuad& quad) {
    const Eigen::Vector3d first = at(nodes_m, quad.node[2]) - at(nodes_m, quad.node[0]);
    const Eigen::Vector3d second = at(nodes_m, quad.node[3]) - at(nodes_m, quad.node[1]);
    const Eigen::Vector3d area = 0.5 * first.cross(second);
    return {area[0], area[1], area[2]};
}

std::vector<double> surface_node_area(const Mesh& mesh) {
    std::vector<double> areas(mesh.nodes.size(), 0.0);
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        const auto corners = corner_areas(mesh.nodes, quad);
        for (int a = 0; a < 4; ++a) areas[quad.node[a]] += corners[a];
    }
    return areas;
}

std::vector<std::array<int, 2>> irregular_edges(std::span<const SurfaceQuad> surface) {
    std::vector<std::array<int, 2>> edges;
    for (const SurfaceQuad& quad : surface) {
        for (int a = 0; a < 4; ++a) {
            const auto ends = std::minmax(quad.node[a], quad.node[(a + 1) % 4]);
            edges.push_back({ends.first, ends.second});
        }
    }
    std::ranges::sort(edges);
    std::vector<std::array<int, 2>> irregular;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        if (end - i != 2) irregular.push_back(edges[i]);
        i = end;
    }
    return irregular;
}

}  // namespace magfsi::structure
