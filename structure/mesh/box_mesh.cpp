#include "structure/mesh/box_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {
namespace {

int node_number(const Box& box, int i, int j, int k) {
    return i + (box.elements[0] + 1) * (j + (box.elements[1] + 1) * k);
}

Hexahedron element_nodes(const Box& box, int i, int j, int k) {
    Hexahedron out{};
    for (int a = 0; a < 8; ++a) {
        out[a] = node_number(box, i + (a & 1), j + ((a >> 1) & 1), k + (a >> 2));
    }
    return out;
}

void check(const Box& box) {
    for (int d = 0; d < 3; ++d) {
        if (!(box.size_m[d] > 0) || box.elements[d] < 1) {
            throw std::invalid_argument(fmt::format(
                "box mesh of {:g} m in {} elements along {} found, both must be positive",
                box.size_m[d], box.elements[d], "xyz"[d]));
        }
    }
}

void add_to_faces(Mesh& mesh, const Box& box, const std::array<int, 3>& ijk, int number) {
    static constexpr std::array<std::array<const char*, 2>, 3> names{
        {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}}};
    for (int d = 0; d < 3; ++d) {
        if (ijk[d] == 0) mesh.faces[names[d][0]].push_back(number);
        if (ijk[d] == box.elements[d]) mesh.faces[names[d][1]].push_back(number);
    }
}

}  // namespace

Mesh box_mesh(const Box& box) {
    check(box);
    const auto [nx, ny, nz] = box.elements;
    Mesh mesh;
    for (int k = 0; k <= nz; ++k) {
        for (int j = 0; j <= ny; ++j) {
            for (int i = 0; i <= nx; ++i) {
                add_to_faces(mesh, box, {i, j, k}, static_cast<int>(mesh.nodes.size()));
                mesh.nodes.push_back({box.size_m[0] * i / nx, box.size_m[1] * j / ny,
                                      box.size_m[2] * k / nz});
            }
        }
    }
    for (int k = 0; k < nz; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                mesh.elements.push_back(element_nodes(box, i, j, k));
            }
        }
    }
    for (int i = 0; i <= nx; ++i) {
        mesh.centre_line.push_back(
            locate(box, {box.size_m[0] * i / nx, box.size_m[1] / 2, box.size_m[2] / 2}));
    }
    return mesh;
}

MaterialPoint locate(const Box& box, const Vec3& point_m) {
    check(box);
    std::array<int, 3> ijk{};
    Vec3 xi{};
    for (int d = 0; d < 3; ++d) {
        const double cells = box.elements[d];
        const double s = std::clamp(point_m[d] / box.size_m[d] * cells, 0.0, cells);
        ijk[d] = std::min(static_cast<int>(s), box.elements[d] - 1);
        xi[d] = 2 * (s - ijk[d]) - 1;
    }
    MaterialPoint out;
    out.node = element_nodes(box, ijk[0], ijk[1], ijk[2]);
    out.weight = shape_values(xi);
    out.element = ijk[0] + box.elements[0] * (ijk[1] + box.elements[1] * ijk[2]);
    return out;
}

}  // namespace magfsi::structure
