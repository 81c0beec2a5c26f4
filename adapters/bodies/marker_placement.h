// SPDX-License-Identifier: GPL-2.0-or-later
// Where the Lagrangian markers of a body sit. They follow the fluid's grid in their
// spacing and the body's elements in their motion.
#pragma once

#include <optional>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/sheet.h"

namespace magfsi::bodies {

// A marker before it is known which rank owns its element.
struct PlacedMarker {
    structure::MaterialPoint point;
    double volume_m3 = 0;     // of fluid that it moves
    double displaced_m3 = 0;  // of the body that it stands for
    double beyond_m3 = 0;     // of fluid that its layer carries beyond the body
    bool core = false;        // deep inside a sheet (coupler/immersed_boundary/no_slip.h)
    int body = 0;
    // Of the surface that it stands for, as in MarkerArea of
    // coupler/immersed_boundary/slip.h; zero where it stands for none.
    std::array<double, 8> first_edge{}, second_edge{};
};

// Markers of a body. The kernel smears a marker over some cells, which enlarges the body;
// so they lie below its surface, by `retraction` grid spacings. (At 0.4 a sphere of 6 or
// 12 cells settles at the same speed, that of the experiment.)
//   both_faces   of a sheet: half of the fluid on each side of the mid-surface, which
//   they
//                reach if the sheet is thin; drawn back from the rim by rim_retraction
//                (at 0.9 a plate of the swimmer's shape falls alike at 15 and 7 cells a
//                width)
//   mid_surface  of a sheet: the paper's; the limit of fine grids is a plate without
//                thickness
//   volume       any body: each marker for its part of the volume
// On a sheet a marker moves its area times one grid spacing: what the kernel takes along.
// Markers of sheets stand for the surface of both faces, not of the rim; in other bodies
// those nearest to the surface for all of it. Nothing is drawn back from where a body is
// clamped, and so stands on something, nor from its ends along axes on which it
// continues. Where the scene does not say, sheets have both faces, other bodies the
// volume. In forcing no_slip: rows about a grid spacing apart (no_slip_markers.cpp).
// body: its number in a scene with coupling. Throws std::invalid_argument on faces asked
// for of a body that is no sheet.
std::vector<PlacedMarker> place_markers(const scene::Scene& scene, std::size_t body);

// A sheet that one layer of markers stands for, in forcing no_slip, and the fluid that
// the layer carries where it moves along its surface
// (coupler/immersed_boundary/layer_inertia.h).
struct CarriedLayer {
    double thickness_m = 0;  // of the sheet
    double carried_m = 0;
};
std::optional<CarriedLayer> carried_layer(const scene::Scene& scene, std::size_t body);

// Along which axes a body spans the fluid's box from one periodic side to the other, or
// between_walls from one wall to the other.
structure::Continues spans_fluid(const scene::Fluid& fluid, const scene::Body& body,
                                 bool between_walls);

}  // namespace magfsi::bodies
