// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/voxel_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>

#include "structure/mesh/block_mesh.h"
#include "structure/mesh/mesh_check.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Removes the elements for which keep(number) is false.
template <class Keep>
void keep_elements(Mesh& mesh, const Keep& keep) {
    std::size_t e = 0;
    std::erase_if(mesh.elements, [&](const Hexahedron&) { return !keep(e++); });
}

// Parts that meet along an edge or at a corner only would be hinged there, so they count
// as separate.
void keep_largest_part(Mesh& mesh, double spacing_m) {
    const std::vector<int> part = parts_joined_by_faces(mesh);
    std::vector<std::size_t> sizes(1 + *std::ranges::max_element(part));
    for (const int p : part) ++sizes[p];
    const auto largest = std::ranges::max_element(sizes) - sizes.begin();
    const double crumbs = part.size() - sizes[largest];
    if (crumbs > most_crumbs * static_cast<double>(part.size())) {
        std::ranges::sort(sizes, std::greater());
        const std::size_t more = sizes.size() > 4 ? sizes.size() - 4 : 0;
        sizes.resize(sizes.size() - more);
        refuse(
            "cubes of {:g} m make {} parts that no face joins, of {}{} cubes; a body is "
            "of one part: take a smaller spacing, or join the parts in the file by "
            "what is at least a cube thick",
            spacing_m, sizes.size() + more, fmt::join(sizes, ", "),
            more > 0 ? fmt::format(" and {} parts more of fewer", more) : "");
    }
    keep_elements(mesh, [&](std::size_t e) { return part[e] == largest; });
}

}  // namespace

Mesh voxel_mesh(const std::array<int, 3>& cells, double spacing_m,
                const std::vector<char>& filled) {
    Mesh mesh = box_mesh(
        {{cells[0] * spacing_m, cells[1] * spacing_m, cells[2] * spacing_m}, cells});
    mesh.centre_line.clear();
    mesh.faces.clear();
    keep_elements(mesh, [&](std::size_t e) { return filled[e] != 0; });
    if (mesh.elements.empty())
        refuse(
            "no cube of {:g} m has its middle inside the surface; take a smaller "
            "spacing, or see that the unit is the file's",
            spacing_m);
    keep_largest_part(mesh, spacing_m);
    drop_unused_nodes(mesh);
    const Bounds all = bounds(mesh.nodes);
    constexpr const char* names[3][2] = {
        {"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}};
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
        const Vec3& x = mesh.nodes[a];
        for (std::size_t d = 0; d < 3; ++d) {
            if (x[d] < all.low_m[d] + 0.5 * spacing_m)
                mesh.faces[names[d][0]].push_back(a);
            if (x[d] > all.high_m[d] - 0.5 * spacing_m)
                mesh.faces[names[d][1]].push_back(a);
        }
    }
    return mesh;
}

}  // namespace magfsi::structure
