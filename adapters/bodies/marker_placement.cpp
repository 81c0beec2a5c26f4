#include "adapters/bodies/marker_placement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/mesh/box_mesh.h"

namespace magfsi::bodies {

namespace {

// Axes of the sheet and across it.
struct SheetAxes {
    std::size_t first, second, across;
};

SheetAxes sheet_axes(const structure::Vec3& size_m) {
    const auto across = static_cast<std::size_t>(
        std::min_element(size_m.begin(), size_m.end()) - size_m.begin());
    return {(across + 1) % 3, (across + 2) % 3, across};
}

int count_along(double length_m, double spacing_m) {
    return std::max(1, static_cast<int>(std::ceil(length_m / spacing_m - 1e-9)));
}

}  // namespace

std::vector<PlacedMarker> place_markers(const scene::Body& body,
                                        const scene::ImmersedBoundary& boundary,
                                        double grid_spacing_m, int number) {
    const auto* mesh = std::get_if<scene::BoxMesh>(&body.mesh);
    if (!mesh) {
        throw std::invalid_argument("body '" + body.name +
                                    "': in a fluid only a block can carry markers; use "
                                    "mesh: {box: ...}");
    }
    const structure::Box box{mesh->size_m, mesh->elements};
    const SheetAxes axes = sheet_axes(box.size_m);
    const double spacing_m = boundary.marker_spacing * grid_spacing_m;
    const double length_1 = box.size_m[axes.first];
    const double length_2 = box.size_m[axes.second];
    const int count_1 = count_along(length_1, spacing_m);
    const int count_2 = count_along(length_2, spacing_m);
    const double volume = length_1 / count_1 * length_2 / count_2 * grid_spacing_m;
    std::vector<double> heights{0.5};
    if (boundary.markers == scene::MarkerSurface::both_faces) heights = {0, 1};

    std::vector<PlacedMarker> markers;
    for (const double height : heights) {
        for (int j = 0; j < count_2; ++j) {
            for (int i = 0; i < count_1; ++i) {
                structure::Vec3 at{};
                at[axes.first] = (i + 0.5) / count_1 * length_1;
                at[axes.second] = (j + 0.5) / count_2 * length_2;
                at[axes.across] = height * box.size_m[axes.across];
                markers.push_back({structure::locate(box, at),
                                   volume / static_cast<double>(heights.size()), number});
            }
        }
    }
    return markers;
}

}  // namespace magfsi::bodies
