// SPDX-License-Identifier: GPL-2.0-or-later
// Helpers of both ways to place markers: the surface that markers stand for, the part of
// it that fluid touches, and the depth of the markers below it. All geometry is that of
// the undeformed body [m].
#pragma once

#include <set>
#include <span>
#include <vector>

#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/bodies/wall_of_planes.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

// For each point the numbers of the markers nearest to it; several if they are equally
// near up to rounding, which keeps the result symmetric. spacing_m: approximate spacing
// of the markers, the bin size of the search; any value gives the same result. There must
// be at least one marker.
std::vector<std::vector<std::size_t>> nearest_markers(
    std::span<const PlacedMarker> markers, const structure::Mesh& mesh,
    std::span<const structure::Vec3> points, double spacing_m);

// Sets the marker's edges so that it stands for this vector area [m2] of the undeformed
// body, which points outward. Leakage through the surface is measured there. A zero area
// leaves the marker as it is.
void set_area(PlacedMarker& marker, const structure::Mesh& mesh,
              const structure::Vec3& area_m2);

// Splits each marker on the border between elements into one marker in each of them, with
// equal shares of its volume and area, if its area would otherwise follow the nodes of
// one element alone. So the markers of a symmetric body remain symmetric.
void share_among_elements(std::vector<PlacedMarker>& markers,
                          const structure::Mesh& mesh);

// Shares a surface among the markers: each piece of it, at most half a spacing wide, goes
// to the marker nearest to its middle, so that the areas of the markers add up to that of
// the surface. faces: 2 if the given side of a sheet stands for both of its faces.
void share_surface(std::span<PlacedMarker> markers, const structure::Mesh& mesh,
                   std::span<const structure::SurfaceQuad> surface, double spacing_m,
                   int faces = 1);

// Thins the markers out towards a part of the surface: their volumes fall linearly to
// zero over one spacing around the depth skin_m, so that the skin is not rounded to whole
// rows of markers, and markers without volume are removed. A body that lies within the
// skin as a whole keeps all its markers.
void draw_back(std::vector<PlacedMarker>& markers, const structure::Mesh& mesh,
               std::span<const structure::SurfaceQuad> surface, double skin_m,
               double spacing_m);

// The parts of a body's surface that no fluid touches: its ends along axes on which it
// continues, and the faces by which it is clamped or moved. A body whose whole surface is
// held has fluid on all of it.
class DryFaces {
  public:
    // Keeps a reference to the mesh.
    DryFaces(const scene::Body& body, const structure::Mesh& mesh,
             const structure::Continues& continues);

    // The given quads less the dry ones.
    std::vector<structure::SurfaceQuad> without(
        std::vector<structure::SurfaceQuad> surface) const;

  private:
    structure::MeshEnds ends_;
    std::vector<std::set<int>> clamped_;  // the nodes of each clamped or moved face
};

// Distances over which the kernel extends the markers of a scene, in forcing no_slip: how
// far outside of the markers the fluid sees the surface of the body. Derived from kernel,
// relaxation time and magic number (kernel_reach.cpp).
struct KernelReach {
    double grid_m;  // spacing of the finest grid
    // Response of planes of markers: in the Stokes layer that fixes the layers of a body,
    // and in a resolved one, which fixes the inertia of a single layer.
    WallOfPlanes wall, resolved_wall;
    // Distance by which the body that a single layer stands for extends beyond the edge
    // of the area of its markers, for motion across the layer [m].
    double edge_m;

    // Number and distance of the layers across a sheet of this thickness.
    EvenPlanes layers(double thickness_m) const {
        return wall.for_body(thickness_m / grid_m);
    }
    bool takes_one_layer(double thickness_m) const {
        return layers(thickness_m).count == 1;
    }
    // Depth of the outermost of many rows below the surface [m], for rows this far apart.
    double depth_m(double apart_m) const { return grid_m * wall.depth(apart_m / grid_m); }
};
// The reach in a scene with a fluid on a lattice and coupling.
KernelReach reach_in(const scene::Scene& scene);

// Markers of a body in forcing no_slip, a grid spacing or so apart, for closer ones make
// the marker system ill-conditioned (coupler/immersed_boundary/no_slip.h). Their volumes
// weight the markers; place_markers sets displaced_m3 and body.
std::vector<PlacedMarker> no_slip_markers(const scene::Body& body,
                                          const structure::Mesh& mesh,
                                          const DryFaces& dry, const KernelReach& reach,
                                          const structure::Continues& continues);

}  // namespace magfsi::bodies
