// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/region.h"

#include <algorithm>

#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// A ray towards larger x crosses the outline an odd number of times.
bool inside_polygon(std::span<const std::array<double, 2>> outline, const Vec3& point) {
    bool inside = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const auto& [xi, yi] = outline[i];
        const auto& [xj, yj] = outline[j];
        if ((yi > point[1]) == (yj > point[1])) continue;
        if (point[0] < xi + (xj - xi) * (point[1] - yi) / (yj - yi)) inside = !inside;
    }
    return inside;
}

}  // namespace

bool holds(const RegionShape& shape, const Vec3& point_m) {
    if (shape.box_m) {
        const auto& [low, high] = *shape.box_m;
        for (std::size_t d = 0; d < 3; ++d)
            if (point_m[d] < low[d] || point_m[d] > high[d]) return false;
    }
    if (shape.ball && norm(point_m - shape.ball->centre_m) > shape.ball->diameter_m / 2)
        return false;
    return shape.polygon_xy_m.empty() || inside_polygon(shape.polygon_xy_m, point_m);
}

void add_regions(Mesh& mesh, std::span<const NamedRegion> regions) {
    if (regions.empty()) return;
    if (mesh.region_names.empty()) {
        mesh.region_names = {rest_of_mesh};
        mesh.region.assign(mesh.elements.size(), 0);
    }
    const int first = static_cast<int>(mesh.region_names.size());
    for (const NamedRegion& region : regions) {
        if (std::ranges::find(mesh.region_names, region.name) != mesh.region_names.end())
            refuse("the region \"{}\" found; the mesh has one of that name", region.name);
        mesh.region_names.push_back(region.name);
    }
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const Vec3 centre = element_centre(mesh, e);
        const auto found = std::ranges::find_if(regions, [&](const NamedRegion& region) {
            return holds(region.shape, centre);
        });
        if (found != regions.end())
            mesh.region[e] = first + static_cast<int>(found - regions.begin());
    }
    for (int r = first; r < static_cast<int>(mesh.region_names.size()); ++r)
        if (std::ranges::find(mesh.region, r) == mesh.region.end())
            refuse(
                "the region \"{}\" found, which holds the centre of no element that "
                "no other region holds; shapes are in the body's own frame",
                mesh.region_names[r]);
}

}  // namespace magfsi::structure
