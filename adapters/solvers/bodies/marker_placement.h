// SPDX-License-Identifier: GPL-2.0-or-later
// Placement of the Lagrangian markers in a body. Their spacing follows the grid of the
// fluid, their motion the elements of the body, so that both meshes can be refined alone.
#pragma once

#include <optional>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/sheet.h"

namespace magfsi::bodies {

// A marker in the undeformed body, before its element is assigned to a rank.
struct PlacedMarker {
    // The place in the mesh of the body; nodes are numbered within the body.
    structure::MaterialPoint point;
    double volume_m3 = 0;     // fluid that the marker moves: dV of eq. (13)
    double displaced_m3 = 0;  // share of the body's volume
    // Fluid outside the body that the marker's layer carries along; negative where the
    // sheet is thicker than its layer (coupler/immersed_boundary/layer_inertia.h).
    double beyond_m3 = 0;
    bool core = false;  // deep inside a sheet (coupler/immersed_boundary/no_slip.h)
    int body = 0;       // number of the body in the scene
    // The two edges whose vector product is the surface that the marker stands for, as
    // weights of the element's nodes [-] (MarkerArea of
    // coupler/immersed_boundary/slip.h). Zero if the marker stands for no surface.
    std::array<double, 8> first_edge{}, second_edge{};
};

// Markers of a body, with their volumes and surfaces. body: its number in a scene with a
// fluid and coupling; mesh: the body's. A sheet consists of columns of equally many
// elements between two large faces (structure/mesh/sheet.h).
//
// In forcing no_slip markers are rows about a grid spacing apart (no_slip_markers.cpp).
// The penalty has them at most half a spacing apart and at least one an element: below
// both faces of a sheet, each layer with half of the fluid, and through the volume of
// other bodies, where each stands for its part of the volume. The kernel spreads the
// force of a marker over some cells, which makes the body larger; hence they lie below
// its surface, in a thin sheet at most as deep as its middle.
//
// A marker on a sheet moves a fluid volume of its area times one grid spacing, the width
// of the layer that the kernel takes along. The surface of a sheet that is measured for
// leakage is that of both faces without the rim; in other bodies the markers nearest to
// the surface stand for all of it. Markers keep no distance from clamped faces, which
// stand on something, and from the ends of a body along axes on which it continues.
std::vector<PlacedMarker> place_markers(const scene::Scene& scene, std::size_t body,
                                        const structure::Mesh& mesh);

// A sheet that is represented by one layer of markers, in forcing no_slip
// (coupler/immersed_boundary/layer_inertia.h).
struct CarriedLayer {
    double thickness_m = 0;  // thickness of the sheet
    // Thickness of the fluid that moves with the layer along its surface.
    double carried_m = 0;
};
// The layer of a body; empty in other forcings, and for bodies of several layers. body,
// mesh: as for place_markers.
std::optional<CarriedLayer> carried_layer(const scene::Scene& scene, std::size_t body,
                                          const structure::Mesh& mesh);

// Axes along which a body spans the box of the fluid from one periodic side to the other;
// with between_walls also those along which it spans it from wall to wall.
structure::Continues spans_fluid(const scene::Fluid& fluid, const scene::Body& body,
                                 const structure::Mesh& mesh, bool between_walls);

}  // namespace magfsi::bodies
