// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Vector3d;

// Face of an element, with its nodes sorted so that the same face of two elements
// compares equal.
struct Face {
    std::array<int, 4> sorted;
    int element, face;
    auto key() const { return std::tie(sorted, element, face); }
};

// All faces of all elements; equal ones follow each other.
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
    refuse(
        "elements {}, {} and {} share one face (nodes {} {} {} {}); a face belongs to "
        "one element or to two",
        a.element, b.element, c.element, a.sorted[0], a.sorted[1], a.sorted[2],
        a.sorted[3]);
}

Vector3d vector(const Vec3& x) {
    return Vector3d(x[0], x[1], x[2]);
}

using Corners = std::array<Vector3d, 4>;

Corners vectors(const Corners4& corners_m) {
    return {vector(corners_m[0]), vector(corners_m[1]), vector(corners_m[2]),
            vector(corners_m[3])};
}

// Derivative of the vector area by u and v at (u, v).
Vector3d area_per_uv(const Corners& x, double u, double v) {
    const Vector3d along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
    const Vector3d along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
    return along_u.cross(along_v);
}

// Number of parts of a length; rounding of the quotient does not add one.
int parts(double length_m, double spacing_m) {
    return std::max<int>(1, std::ceil(length_m / spacing_m - 1e-9));
}

Vector3d on_quad(const Corners4& x, double u, double v) {
    const auto shape = quad_shape(u, v);
    Vector3d out = Vector3d::Zero();
    for (int a = 0; a < 4; ++a) out += shape[a] * vector(x[a]);
    return out;
}

// Foot of the perpendicular by Gauss-Newton iteration on the distance, from the middle.
// It may lie outside of the unit square.
std::array<double, 2> foot_of_perpendicular(const Corners4& x, const Vector3d& point) {
    double u = 0.5, v = 0.5;
    for (int step = 0; step < 20; ++step) {
        Eigen::Matrix<double, 3, 2> tangents;
        tangents.col(0) = (1 - v) * vector(x[1]) + v * vector(x[2]) -
                          (1 - v) * vector(x[0]) - v * vector(x[3]);
        tangents.col(1) = (1 - u) * vector(x[3]) + u * vector(x[2]) -
                          (1 - u) * vector(x[0]) - u * vector(x[1]);
        const Vector3d gap = point - on_quad(x, u, v);
        const Eigen::Vector2d change =
            (tangents.transpose() * tangents).ldlt().solve(tangents.transpose() * gap);
        if (!change.allFinite()) break;
        u = std::clamp(u + change[0], -1.0, 2.0);
        v = std::clamp(v + change[1], -1.0, 2.0);
        if (change.norm() < 1e-13) break;
    }
    return {u, v};
}

// Share of the way from a to b at the point of the edge that is nearest.
double nearest_on_edge(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
    return std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
}

}  // namespace

std::array<int, 4> face_corners(int face) {
    const int d = face / 2;
    const int u = 1 << ((d + 1) % 3);
    const int v = 1 << ((d + 2) % 3);
    const int base = (face % 2) << d;
    // u x v points along +d: outward on the high side; on the low side the order is
    // reversed.
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
            surface.push_back(outer_quad(mesh, {static_cast<int>(e), f}));
        }
    }
    return surface;
}

SurfaceQuad outer_quad(const Mesh& mesh, const FaceOfElement& at) {
    SurfaceQuad quad{{}, at.element, at.face};
    const auto corners = face_corners(at.face);
    for (int a = 0; a < 4; ++a) quad.node[a] = mesh.elements[at.element][corners[a]];
    return quad;
}

Corners4 corners(const std::vector<Vec3>& nodes_m, const std::array<int, 4>& nodes) {
    return {nodes_m[nodes[0]], nodes_m[nodes[1]], nodes_m[nodes[2]], nodes_m[nodes[3]]};
}

std::array<double, 4> quad_shape(double u, double v) {
    return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

// 2x2 Gauss points: exact for plane parallelograms, else of fourth order in the edge.
double quad_area(const Corners4& corners_m) {
    const Corners x = vectors(corners_m);
    std::array<double, 4> areas{};  // integrals of the four shape functions
    const double q = 0.5 / std::sqrt(3.0);
    for (const double u : {0.5 - q, 0.5 + q}) {
        for (const double v : {0.5 - q, 0.5 + q}) {
            const double area = 0.25 * area_per_uv(x, u, v).norm();
            const auto shape = quad_shape(u, v);
            for (int a = 0; a < 4; ++a) areas[a] += shape[a] * area;
        }
    }
    return areas[0] + areas[1] + areas[2] + areas[3];
}

Vec3 quad_area_vector(const Corners4& corners_m) {
    const Corners x = vectors(corners_m);
    const Vector3d first = x[2] - x[0];
    const Vector3d second = x[3] - x[1];
    const Vector3d area = 0.5 * first.cross(second);
    return {area[0], area[1], area[2]};
}

std::array<double, 2> nearest_on_quad(const Corners4& corners_m, const Vec3& point_m) {
    const Vector3d point = vector(point_m);
    const auto [u, v] = foot_of_perpendicular(corners_m, point);
    if (u >= 0 && u <= 1 && v >= 0 && v <= 1) return {u, v};
    static constexpr std::array<std::array<double, 2>, 4> at{
        {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<double, 2> best{};
    double least = INFINITY;
    for (int a = 0; a < 4; ++a) {
        const int b = (a + 1) % 4;
        const double t =
            nearest_on_edge(vector(corners_m[a]), vector(corners_m[b]), point);
        const double pu = (1 - t) * at[a][0] + t * at[b][0];
        const double pv = (1 - t) * at[a][1] + t * at[b][1];
        const double away = (on_quad(corners_m, pu, pv) - point).norm();
        if (away < least) {
            least = away;
            best = {pu, pv};
        }
    }
    return best;
}

std::vector<QuadCell> cut_quad(const Corners4& corners_m, double spacing_m) {
    if (!(spacing_m > 0)) {
        refuse("points {:g} m apart on a surface found, the spacing must be positive",
               spacing_m);
    }
    const Corners x = vectors(corners_m);
    const int nu = parts(std::max((x[1] - x[0]).norm(), (x[2] - x[3]).norm()), spacing_m);
    const int nv = parts(std::max((x[3] - x[0]).norm(), (x[2] - x[1]).norm()), spacing_m);
    std::vector<QuadCell> cells;
    double sum = 0;
    for (int j = 0; j < nv; ++j) {
        for (int i = 0; i < nu; ++i) {
            const double u = (i + 0.5) / nu, v = (j + 0.5) / nv;
            const Vector3d area = area_per_uv(x, u, v);
            const Vector3d normal = area.normalized();
            cells.push_back({u, v, area.norm(), {normal[0], normal[1], normal[2]}});
            sum += area.norm();
        }
    }
    // Areas by the midpoint rule are scaled so that the quad keeps its area.
    const double scale = quad_area(corners_m) / sum;
    for (QuadCell& cell : cells) cell.area_m2 *= scale;
    return cells;
}

std::vector<double> surface_areas(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements) {
    Mesh mesh;
    mesh.nodes = nodes_m;
    mesh.elements = elements;
    std::vector<Vec3> share(nodes_m.size(), Vec3{});
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        const Vec3 area = quad_area_vector(corners(nodes_m, quad.node));
        for (int node : quad.node) share[node] += 0.25 * area;
    }
    std::vector<double> out;
    out.reserve(share.size());
    for (const Vec3& v : share) out.push_back(norm(v));
    return out;
}

}  // namespace magfsi::structure
