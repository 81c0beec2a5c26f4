// Points, faces and cells of this rank's slab, in the order that OpenFOAM asks for.
#pragma once

#include <functional>

#include "DynamicList.H"
#include "adapters/openfoam/engine/engine.h"
#include "face.H"
#include "pointField.H"

namespace magfsi::openfoam {

struct BoxFaces {
    Foam::pointField points;
    Foam::DynamicList<Foam::face> faces;      // inner ones, then side by side
    Foam::DynamicList<Foam::label> owner;     // of every face
    Foam::DynamicList<Foam::label> neighbor;  // of the inner ones
    Foam::label inner = 0;                    // faces between two cells of this rank
    Foam::label of_side[6] = {};              // faces
};

// Of this rank's slab.
std::array<int, 3> slab_cells(const BoxMesh& box);

// A face: the cell above it along its axis, or where that would be, and whether its
// normal points that way.
using VisitFace = std::function<void(const std::array<int, 3>&, int axis, bool upwards)>;

// In the order of their numbers. side_order: of the slab's sides in the list of faces.
void visit_faces(const BoxMesh& box, const std::vector<int>& side_order,
                 const VisitFace& visit);
BoxFaces make_faces(const BoxMesh& box, const std::vector<int>& side_order);

}  // namespace magfsi::openfoam
