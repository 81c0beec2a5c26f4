// SPDX-License-Identifier: GPL-2.0-or-later
// OpenFOAM's mesh of a box, made in memory: no file to write, decompose and read. Points,
// faces and cells of this rank's slab are in the order that OpenFOAM asks for; by it the
// fluxes on faces become plain numbers, the same on any cut of the box into slabs.
#pragma once

#include <vector>

#include "Time.H"
#include "adapters/openfoam/engine/engine.h"
#include "autoPtr.H"
#include "fvMesh.H"
#include "surfaceFields.H"
#include "volFields.H"

namespace magfsi::openfoam {

// Names of the patches, by side.
extern const std::array<const char*, 6> side_names;

// Cells are numbered with x fastest. Collective.
Foam::autoPtr<Foam::fvMesh> make_mesh(const Foam::Time& time, const BoxMesh& box);

// Where FlowState::flux has a face of the mesh. sign: -1 where the face's normal points
// out of the slab's lower side, against the axis.
struct FacePlace {
    int axis = 0;
    int sign = 1;
    std::size_t index = 0;
};

// By the number of the face.
std::vector<FacePlace> face_places(const BoxMesh& box);

void take_flux(const Foam::surfaceScalarField& phi, const std::vector<FacePlace>& places,
               FlowState& out);
void put_flux(const FlowState& state, const std::vector<FacePlace>& places,
              Foam::surfaceScalarField& phi);

}  // namespace magfsi::openfoam
