#include "structure/mesh/structured.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <stdexcept>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {
namespace {

int node_number(const GridCounts& elements, int i, int j, int k) {
    return i + (elements[0] + 1) * (j + (elements[1] + 1) * k);
}

Hexahedron element_nodes(const GridCounts& elements, int i, int j, int k) {
    Hexahedron out{};
    for (int a = 0; a < 8; ++a) {
        out[a] = node_number(elements, i + (a & 1), j + ((a >> 1) & 1), k + (a >> 2));
    }
    return out;
}

void check(const GridCounts& elements) {
    double nodes = 1;
    for (int d = 0; d < 3; ++d) {
        nodes *= elements[d] + 1.0;
        if (elements[d] < 1) {
            throw std::invalid_argument(
                fmt::format("mesh of {} elements along direction {} found, at least 1 is "
                            "allowed",
                            elements[d], "xyz"[d]));
        }
    }
    if (nodes > INT_MAX) {
        throw std::invalid_argument(fmt::format(
            "mesh of {:g} nodes found, at most {} are allowed", nodes, INT_MAX));
    }
}

void add_to_faces(Mesh& mesh, const GridCounts& elements, const std::array<int, 3>& ijk) {
    static constexpr std::array<std::array<const char*, 2>, 3> names{
        {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}}};
    const int number = node_number(elements, ijk[0], ijk[1], ijk[2]);
    for (int d = 0; d < 3; ++d) {
        if (ijk[d] == 0) mesh.faces[names[d][0]].push_back(number);
        if (ijk[d] == elements[d]) mesh.faces[names[d][1]].push_back(number);
    }
}

}  // namespace

Mesh structured_mesh(const GridCounts& elements,
                     const std::function<Vec3(int i, int j, int k)>& position) {
    check(elements);
    const auto [nx, ny, nz] = elements;
    Mesh mesh;
    for (int k = 0; k <= nz; ++k) {
        for (int j = 0; j <= ny; ++j) {
            for (int i = 0; i <= nx; ++i) {
                add_to_faces(mesh, elements, {i, j, k});
                mesh.nodes.push_back(position(i, j, k));
            }
        }
    }
    for (int k = 0; k < nz; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                mesh.elements.push_back(element_nodes(elements, i, j, k));
            }
        }
    }
    for (int i = 0; i <= nx; ++i) {
        mesh.centre_line.push_back(
            structured_point(elements, {double(i), 0.5 * ny, 0.5 * nz}));
    }
    return mesh;
}

MaterialPoint structured_point(const GridCounts& elements, const Vec3& s) {
    std::array<int, 3> ijk{};
    Vec3 xi{};
    for (int d = 0; d < 3; ++d) {
        const double inside = std::clamp(s[d], 0.0, static_cast<double>(elements[d]));
        ijk[d] = std::min(static_cast<int>(inside), elements[d] - 1);
        xi[d] = 2 * (inside - ijk[d]) - 1;
    }
    MaterialPoint out;
    out.node = element_nodes(elements, ijk[0], ijk[1], ijk[2]);
    out.weight = shape_values(xi);
    out.element = ijk[0] + elements[0] * (ijk[1] + elements[1] * ijk[2]);
    return out;
}

}  // namespace magfsi::structure
