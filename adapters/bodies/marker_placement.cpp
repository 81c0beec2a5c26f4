#include "adapters/bodies/marker_placement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adapters/bodies/body_mesh.h"
#include "structure/mesh/box_mesh.h"
#include "structure/mesh/sheet.h"
#include "structure/mesh/surface_points.h"

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

std::vector<PlacedMarker> on_block(const scene::BoxMesh& mesh,
                                   const scene::ImmersedBoundary& boundary,
                                   double grid_spacing_m, int number) {
    const structure::Box box{mesh.size_m, mesh.elements};
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

// A sheet of any outline, curved or folded.
std::vector<PlacedMarker> on_sheet(const structure::Mesh& mesh,
                                   const structure::Sheet& sheet,
                                   const scene::ImmersedBoundary& boundary,
                                   double grid_spacing_m, int number) {
    const double spacing_m = boundary.marker_spacing * grid_spacing_m;
    std::vector<PlacedMarker> markers;
    const auto add = [&](const std::vector<structure::SurfacePoint>& points,
                         double share) {
        for (const auto& p : points)
            markers.push_back({p.point, share * p.area_m2 * grid_spacing_m, number});
    };
    if (boundary.markers == scene::MarkerSurface::mid_surface) {
        add(structure::mid_surface_points(mesh, sheet, spacing_m), 1);
        return markers;
    }
    for (const auto& side : {structure::bottom_of(sheet), structure::top_of(sheet)})
        add(structure::surface_points(mesh, side, spacing_m), 0.5);
    return markers;
}

}  // namespace

std::vector<PlacedMarker> place_markers(const scene::Body& body,
                                        const scene::ImmersedBoundary& boundary,
                                        double grid_spacing_m, int number) {
    if (const auto* box = std::get_if<scene::BoxMesh>(&body.mesh))
        return on_block(*box, boundary, grid_spacing_m, number);
    const structure::Mesh mesh = to_mesh(body);
    const auto sheet = structure::find_sheet(mesh);
    if (sheet) return on_sheet(mesh, *sheet, boundary, grid_spacing_m, number);
    throw std::invalid_argument(
        "body '" + body.name +
        "' is no sheet (columns of equally many elements between two large faces): in a "
        "fluid only blocks and sheets can carry markers");
}

}  // namespace magfsi::bodies
