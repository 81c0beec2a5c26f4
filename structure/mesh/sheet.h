// SPDX-License-Identifier: GPL-2.0-or-later
// Sheets: bodies that consist of columns of elements from one large face to the other.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "structure/mesh/body_points.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

// Axes along which a body continues beyond its mesh. A body that spans a periodic box has
// no surface at its two ends there.
using Continues = std::array<bool, 3>;

// The ends of a mesh on the axes along which the body continues.
class MeshEnds {
  public:
    MeshEnds(const Mesh& mesh, const Continues& continues);

    // True if all nodes of the quad lie on one end of such an axis.
    bool hold(const SurfaceQuad& quad) const;

  private:
    const Mesh& mesh_;
    Continues continues_;
    Bounds box_;
};

// Column of elements through the thickness. elements: from bottom to top. levels: four
// nodes of each level, one level more than elements, counter-clockwise as seen from the
// top. bottom and top: its outer faces.
struct SheetColumn {
    std::vector<int> elements;
    std::vector<std::array<int, 4>> levels;
    SurfaceQuad bottom, top;
};

// A sheet as columns, in no particular order.
struct Sheet {
    std::vector<SheetColumn> columns;
    int layers = 0;  // number of elements in each column
};

// The columns of a mesh that is a sheet, else nothing. Columns follow each element's
// thinnest direction through opposite faces of its neighbours to the surface. In a sheet
// they contain every element once, all have the same number of layers, and their ends
// form two separate sides. The sheet may be curved or folded. The result is empty for
// other bodies, for one-sided sheets (Moebius) and for a single cube. The top is the side
// whose area vector points towards +z (if that component vanishes, as on a closed shell,
// +y, then +x). A body is never thin along an axis on which it continues.
std::optional<Sheet> find_sheet(const Mesh& mesh, const Continues& continues = {});

// The surface of the sheet that is on neither of its two sides.
std::vector<SurfaceQuad> rim_of(const Mesh& mesh, const Sheet& sheet);

enum class SheetSide { bottom, top };

// Points depth_m below one side, but no deeper than the middle of the thickness. The quad
// between the points at that depth on the column's edges is cut as in surface_points.
// Normals point towards the top.
std::vector<SurfacePoint> points_below_face(const Mesh& mesh, const Sheet& sheet,
                                            SheetSide side, double depth_m,
                                            double spacing_m);

}  // namespace magfsi::structure
