// SPDX-License-Identifier: GPL-2.0-or-later
// Sheets: bodies made of columns of elements from one large face to the other.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "structure/mesh/body_points.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// Bodies that go on beyond their mesh: one that spans a periodic box has no surface at
// its two ends there. Along which axes of the mesh a body continues:
using Continues = std::array<bool, 3>;

class MeshEnds {
  public:
    MeshEnds(const Mesh& mesh, const Continues& continues);

    // Whether all nodes of the quad lie on one end of an axis along which it continues.
    bool hold(const SurfaceQuad& quad) const;

  private:
    const Mesh& mesh_;
    Continues continues_;
    Bounds box_;
};

// One column across the thickness: its elements from bottom to top, and the four nodes of
// each level (one level more than elements), in the cyclic order that seen from the top
// is counter-clockwise. bottom and top are its two outer faces.
struct SheetColumn {
    std::vector<int> elements;
    std::vector<std::array<int, 4>> levels;
    SurfaceQuad bottom, top;
};

struct Sheet {
    std::vector<SheetColumn> columns;
    int layers = 0;  // elements a column
};

// The sheet that a mesh is, if it is one: each element's thinnest direction, followed
// through the opposite faces of its neighbours to the surface, gives columns that hold
// every element once, all with as many layers, and whose ends form two separate sides.
// The sheet may be curved or folded. Empty for other bodies, for sheets of one side
// (Moebius) and for cubes of one element. The top is the side whose area vector points
// towards +z (+y, +x where that vanishes, as on a closed shell). A body is never thin
// along an axis on which it continues.
std::optional<Sheet> find_sheet(const Mesh& mesh, const Continues& continues = {});

// The boundary of the sheet between its two sides.
std::vector<SurfaceQuad> rim_of(const Mesh& mesh, const Sheet& sheet);

enum class SheetSide { bottom, top };

// Points `depth_m` below one side, but no deeper than the middle of the thickness, cut as
// surface_points cuts the quad between the points on the column's edges; normals point to
// the top.
std::vector<SurfacePoint> points_below_face(const Mesh& mesh, const Sheet& sheet,
                                            SheetSide side, double depth_m,
                                            double spacing_m);

// Points in the middle of the thickness, cut as surface_points cuts the quad between the
// middles of the column's edges; normals point to the top.
std::vector<SurfacePoint> mid_surface_points(const Mesh& mesh, const Sheet& sheet,
                                             double spacing_m);

}  // namespace magfsi::structure
