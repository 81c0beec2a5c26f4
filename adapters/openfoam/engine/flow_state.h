// The state of a flow between OpenFOAM's fields and plain numbers, the same on any cut of
// the box into slabs.
#pragma once

#include <vector>

#include "adapters/openfoam/engine/engine.h"
#include "surfaceFields.H"
#include "volFields.H"

namespace magfsi::openfoam {

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
