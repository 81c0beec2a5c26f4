// SPDX-License-Identifier: GPL-2.0-or-later
// What both ways to place markers share: the surface that markers stand for, what of it
// meets fluid, and how far below it they lie.
#pragma once

#include <set>
#include <span>
#include <vector>

#include "adapters/bodies/marker_placement.h"
#include "adapters/bodies/wall_of_planes.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

// For each point the nearest of the markers, all that are as near. spacing_m: about that
// of the markers.
std::vector<std::vector<std::size_t>> nearest_markers(
    std::span<const PlacedMarker> markers, const structure::Mesh& mesh,
    std::span<const structure::Vec3> points, double spacing_m);

// The marker stands for this vector area [m2], outward, of the undeformed body: there
// leakage is measured.
void set_area(PlacedMarker& marker, const structure::Mesh& mesh,
              const structure::Vec3& area_m2);

// A marker on the border of elements becomes one in each, with a share of it, where its
// area would follow the nodes of one of them alone: a body that is symmetric stays so.
void share_among_elements(std::vector<PlacedMarker>& markers,
                          const structure::Mesh& mesh);

// Each piece of the surface, of half a spacing and less, goes to the marker nearest to
// its middle: the areas of the markers add up to that of the surface. faces: 2 where one
// side of a sheet stands for both.
void share_surface(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                   std::span<const structure::SurfaceQuad> surface, double spacing_m,
                   int faces = 1);

// Thins the markers out towards a part of the surface: none within skin_m, smooth over
// one spacing so that the skin is not rounded to rows of markers.
void draw_back(std::vector<PlacedMarker>& markers, const structure::Mesh& mesh,
               std::span<const structure::SurfaceQuad> surface, double skin_m,
               double spacing_m);

// What bounds the body but no fluid: the ends along axes on which it continues, and where
// it is clamped to something. A body that is held all around has fluid there.
class DryFaces {
  public:
    DryFaces(const scene::Body& body, const structure::Mesh& mesh,
             const structure::Continues& continues);

    std::vector<structure::SurfaceQuad> without(
        std::vector<structure::SurfaceQuad> surface) const;

  private:
    structure::MeshEnds ends_;
    std::vector<std::set<int>> clamped_;
};

// What the markers of a scene reach around them.
struct KernelReach {
    double grid_m;
    WallOfPlanes wall, resolved_wall;
    // How far one layer reaches beyond the area of its markers where it moves broadside.
    double edge_m;

    // Layers across a sheet of this thickness.
    EvenPlanes layers(double thickness_m) const {
        return wall.for_body(thickness_m / grid_m);
    }
    bool takes_one_layer(double thickness_m) const {
        return layers(thickness_m).count == 1;
    }
    // From a surface to the first of many rows.
    double depth_m(double apart_m) const { return grid_m * wall.depth(apart_m / grid_m); }
    // How much further the rim of two layers reaches, and that of more.
    double rim_of_two_m, rim_of_more_m;
};
KernelReach reach_in(const scene::Scene& scene);

// Of a body in forcing no_slip, where the marker system must be well conditioned
// (coupler/immersed_boundary/no_slip.h); volumes are shares of the body's.
std::vector<PlacedMarker> no_slip_markers(const scene::Body& body,
                                          const structure::Mesh& mesh,
                                          const DryFaces& dry, const KernelReach& reach,
                                          const structure::Continues& continues);

}  // namespace magfsi::bodies
