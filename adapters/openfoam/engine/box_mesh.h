// OpenFOAM's mesh of a box, made in memory: no file to write, decompose and read. Points,
// faces and cells of this rank's slab are in the order that OpenFOAM asks for; by it the
// fluxes on faces become plain numbers, the same on any cut of the box into slabs.
#pragma once

#include <functional>
#include <vector>

#include "DynamicList.H"
#include "Time.H"
#include "adapters/openfoam/engine/engine.h"
#include "autoPtr.H"
#include "face.H"
#include "fvMesh.H"
#include "pointField.H"
#include "surfaceFields.H"
#include "volFields.H"

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

// Names of the patches, by side.
extern const std::array<const char*, 6> side_names;

// Of the sides of this rank's slab in the mesh's list of faces.
std::vector<int> side_order(const BoxMesh& box);

// Cells are numbered with x fastest. Collective.
Foam::autoPtr<Foam::fvMesh> make_mesh(const Foam::Time& time, const BoxMesh& box);

// Where FlowState::flux has a face of the mesh. sign: -1 where the face's normal points
// out of the slab's lower side, against the axis.
struct FacePlace {
    int axis = 0;
    int sign = 1;
    std::size_t index = 0;
};

// By the number of the face. side_order: as in make_faces.
std::vector<FacePlace> face_places(const BoxMesh& box,
                                   const std::vector<int>& side_order);

void take_flux(const Foam::surfaceScalarField& phi, const std::vector<FacePlace>& places,
               FlowState& out);
void put_flux(const FlowState& state, const std::vector<FacePlace>& places,
              Foam::surfaceScalarField& phi);

}  // namespace magfsi::openfoam
