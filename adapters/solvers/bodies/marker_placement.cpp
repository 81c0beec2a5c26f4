// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/marker_placement.h"

#include "adapters/scene/checks.h"
#include "adapters/solvers/bodies/filled_cubes.h"
#include "adapters/solvers/bodies/marker_surface.h"
#include "adapters/solvers/bodies/scene_to_body.h"
#include "base/fitted/constants.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/sheet.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

namespace {

// Markers of a sheet, in one layer below each face. Each layer moves half of the fluid.
std::vector<PlacedMarker> below_both_faces(const structure::Mesh& mesh,
                                           const structure::Sheet& sheet,
                                           const DryFaces& dry, double grid_m) {
    const double apart_m = fitted::marker_spacing * grid_m;
    std::vector<PlacedMarker> markers;
    for (const auto side : {structure::SheetSide::bottom, structure::SheetSide::top}) {
        for (const auto& p : structure::points_below_face(
                 mesh, sheet, side, fitted::retraction * grid_m, apart_m)) {
            markers.push_back({p.point, 0.5 * p.area_m2 * grid_m});
            // The normals of both layers point towards the top.
            const double area_m2 =
                side == structure::SheetSide::top ? p.area_m2 : -p.area_m2;
            set_area(
                markers.back(), mesh,
                {area_m2 * p.normal[0], area_m2 * p.normal[1], area_m2 * p.normal[2]});
        }
    }
    draw_back(markers, mesh, dry.without(structure::rim_of(mesh, sheet)),
              fitted::rim_retraction * grid_m, apart_m);
    return markers;
}

// Markers throughout the volume of a body, thinned out towards its wet surface.
std::vector<PlacedMarker> through_volume(const structure::Mesh& mesh, const DryFaces& dry,
                                         double grid_m) {
    const double apart_m = fitted::marker_spacing * grid_m;
    std::vector<PlacedMarker> markers;
    for (const auto& p : structure::volume_points(mesh, apart_m))
        markers.push_back({p.point, p.volume_m3});
    const auto surface = dry.without(structure::boundary_quads(mesh));
    draw_back(markers, mesh, surface, fitted::retraction * grid_m, apart_m);
    share_surface(markers, mesh, surface, apart_m);
    return markers;
}

// Shares the body's volume among its markers in proportion to the fluid that they move.
void share_body(std::vector<PlacedMarker>& markers, double body_m3, int number) {
    double sum = 0;
    for (const PlacedMarker& m : markers) sum += m.volume_m3;
    for (PlacedMarker& m : markers) {
        m.displaced_m3 = m.volume_m3 * body_m3 / sum;
        m.body = number;
    }
}

}  // namespace

std::vector<PlacedMarker> place_markers(const scene::Scene& scene, std::size_t number,
                                        const structure::Mesh& mesh) {
    const scene::Body& body = scene.bodies[number];
    const bool no_slip =
        scene.coupling->immersed_boundary.forcing == coupler::Forcing::no_slip;
    const structure::Continues continues = spans_fluid(*scene.fluid, body, mesh, no_slip);
    const double grid_m = scene.fluid->finest_spacing_m();
    const auto sheet = structure::find_sheet(mesh, continues);
    const DryFaces dry(body, mesh, continues);
    auto markers = no_slip ? no_slip_markers(body, mesh, dry, reach_in(scene), continues)
                   : sheet ? below_both_faces(mesh, *sheet, dry, grid_m)
                           : through_volume(mesh, dry, grid_m);
    const auto* cubes = std::get_if<structure::VoxelMesh>(&body.mesh);
    share_body(markers, cubes ? surface_volume_m3(*cubes) : structure::volume_m3(mesh),
               static_cast<int>(number));
    return markers;
}

structure::Continues spans_fluid(const scene::Fluid& fluid, const scene::Body& body,
                                 const structure::Mesh& mesh, bool between_walls) {
    structure::Continues spans{};
    for (int d = 0; d < 3; ++d)
        spans[d] = scene::spans_fluid(fluid, body, d, extent(mesh, d), between_walls);
    return spans;
}

}  // namespace magfsi::bodies
