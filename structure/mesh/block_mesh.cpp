// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/block_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <functional>
#include <numbers>

#include "structure/lattice/hexahedron.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using GridCounts = std::array<int, 3>;  // numbers along the three grid directions

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

void add_to_faces(Mesh& mesh, const GridCounts& elements, const std::array<int, 3>& ijk) {
    static constexpr std::array<std::array<const char*, 2>, 3> names{
        {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}}};
    const int number = node_number(elements, ijk[0], ijk[1], ijk[2]);
    for (int d = 0; d < 3; ++d) {
        if (ijk[d] == 0) mesh.faces[names[d][0]].push_back(number);
        if (ijk[d] == elements[d]) mesh.faces[names[d][1]].push_back(number);
    }
}

// Point at the grid coordinates s, in units of elements: 0 to nx, 0 to ny, 0 to nz.
MaterialPoint grid_point(const GridCounts& elements, const Vec3& s) {
    std::array<int, 3> ijk{};
    Vec3 xi{};
    for (int d = 0; d < 3; ++d) {
        const double inside = std::clamp(s[d], 0.0, static_cast<double>(elements[d]));
        ijk[d] = std::min(static_cast<int>(inside), elements[d] - 1);
        xi[d] = 2 * (inside - ijk[d]) - 1;
    }
    return {element_nodes(elements, ijk[0], ijk[1], ijk[2]), shape_values(xi),
            ijk[0] + elements[0] * (ijk[1] + elements[1] * ijk[2])};
}

// Mesh of a grid whose nodes lie at position(i, j, k), with faces and centre line.
Mesh grid_mesh(const GridCounts& elements,
               const std::function<Vec3(int i, int j, int k)>& position) {
    const auto [nx, ny, nz] = elements;
    const double nodes = (nx + 1.0) * (ny + 1.0) * (nz + 1.0);
    if (nodes > INT_MAX) {
        refuse("mesh of {:g} nodes found, at most {} are allowed", nodes, INT_MAX);
    }
    Mesh mesh;
    for (int k = 0; k <= nz; ++k) {
        for (int j = 0; j <= ny; ++j) {
            for (int i = 0; i <= nx; ++i) {
                add_to_faces(mesh, elements, {i, j, k});
                mesh.nodes.push_back(position(i, j, k));
                if (i == nx || j == ny || k == nz) continue;
                mesh.elements.push_back(element_nodes(elements, i, j, k));
            }
        }
    }
    for (int i = 0; i <= nx; ++i) {
        mesh.centre_line.push_back(grid_point(elements, {double(i), 0.5 * ny, 0.5 * nz}));
    }
    return mesh;
}

void check(const Box& box) {
    for (int d = 0; d < 3; ++d) {
        if (!(box.size_m[d] > 0) || box.elements[d] < 1) {
            refuse(
                "box mesh of {:g} m in {} elements along {} found, both must be positive",
                box.size_m[d], box.elements[d], "xyz"[d]);
        }
    }
}

void check(const ObliquePlate& plate) {
    const auto [along_a, along_b, layers] = plate.elements_per_cell;
    if (plate.cells[0] < 1 || plate.cells[1] < 1 || along_a < 1 || along_b < 1 ||
        layers < 1) {
        refuse(
            "oblique plate of {} columns and {} rows in {} x {} x {} elements per cell "
            "found; each must be at least 1",
            plate.cells[0], plate.cells[1], along_a, along_b, layers);
    }
    if (!(plate.length_a_m > 0 && plate.length_b_m > 0 && plate.thickness_m > 0)) {
        refuse(
            "oblique plate with sides of {:g} m and {:g} m and {:g} m thickness found; "
            "each must be positive",
            plate.length_a_m, plate.length_b_m, plate.thickness_m);
    }
    if (!(plate.angle_rad > 0 && plate.angle_rad < std::numbers::pi)) {
        refuse(
            "oblique plate with an angle of {:g} rad between its sides found; it must be "
            "above 0 and below pi",
            plate.angle_rad);
    }
}

// Shift along x of the mesh line at height s [cells], in units of length_b cos(angle).
double lean(const ObliquePlate& plate, double s) {
    if (!plate.zigzag) return s;
    const double in_pair = s - 2 * std::floor(s / 2);
    return in_pair <= 1 ? in_pair : 2 - in_pair;
}

}  // namespace

Mesh box_mesh(const Box& box) {
    check(box);
    const auto [nx, ny, nz] = box.elements;
    return grid_mesh(box.elements, [&](int i, int j, int k) {
        return Vec3{box.size_m[0] * i / nx, box.size_m[1] * j / ny,
                    box.size_m[2] * k / nz};
    });
}

MaterialPoint locate(const Box& box, const Vec3& point_m) {
    check(box);
    Vec3 s{};
    for (int d = 0; d < 3; ++d) s[d] = point_m[d] / box.size_m[d] * box.elements[d];
    return grid_point(box.elements, s);
}

Mesh oblique_mesh(const ObliquePlate& plate) {
    check(plate);
    const auto [along_a, along_b, layers] = plate.elements_per_cell;
    const double step_x = plate.length_b_m * std::cos(plate.angle_rad);
    const double step_y = plate.length_b_m * std::sin(plate.angle_rad);
    const int nx = plate.cells[0] * along_a;
    const int ny = plate.cells[1] * along_b;
    Mesh mesh = grid_mesh({nx, ny, layers}, [&](int i, int j, int k) {
        const double row = static_cast<double>(j) / along_b;
        return Vec3{plate.length_a_m * i / along_a + step_x * lean(plate, row),
                    step_y * row, plate.thickness_m * k / layers};
    });
    for (int row = 0; row < plate.cells[1]; ++row) {
        for (int column = 0; column < plate.cells[0]; ++column) {
            mesh.region_names.push_back(fmt::format("row {} column {}", row, column));
        }
    }
    for (int e = 0; e < nx * ny * layers; ++e) {
        mesh.region.push_back(e / nx % ny / along_b * plate.cells[0] + e % nx / along_a);
    }
    return mesh;
}

}  // namespace magfsi::structure
