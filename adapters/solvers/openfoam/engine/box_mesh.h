// SPDX-License-Identifier: GPL-2.0-or-later
// OpenFOAM's mesh of a box, made in memory: no mesh is written, decomposed or read.
// Points, faces and cells of this rank's slab are numbered as OpenFOAM requires. Since
// the numbering is known, the fluxes on faces can be stored as plain arrays that are the
// same for any cut of the box into slabs.
#pragma once

#include <vector>

#include "Time.H"
#include "adapters/solvers/openfoam/engine/engine.h"
#include "autoPtr.H"
#include "fvMesh.H"
#include "surfaceFields.H"
#include "volFields.H"

namespace magfsi::openfoam {

// Names of the patches, in the order x_min, x_max, y_min, y_max, z_min, z_max.
extern const std::array<const char*, 6> side_names;

// Makes the mesh of this rank's slab. Cells are numbered with x fastest. Collective over
// the ranks.
Foam::autoPtr<Foam::fvMesh> make_mesh(const Foam::Time& time, const BoxMesh& box);

// Reads the mesh of the case.
Foam::autoPtr<Foam::fvMesh> read_mesh(const Foam::Time& time);

// Copies all fluxes [m3/s] of a mesh that was read, inner faces first, then patch by
// patch.
void take_face_flux(const Foam::surfaceScalarField& phi, std::vector<double>& out);
void put_face_flux(const std::vector<double>& from, Foam::surfaceScalarField& phi);

// Place of a face of the mesh in FlowState::flux. `axis` is the axis across which the
// face lies, `index` its place in flux[axis]; `sign` is -1 if the face's normal points
// against the axis, at the slab's lower side.
struct FacePlace {
    int axis = 0;
    int sign = 1;
    std::size_t index = 0;
};

// Places of all faces of this rank, indexed by OpenFOAM's number of the face.
std::vector<FacePlace> face_places(const BoxMesh& box);

// Copies the fluxes [m3/s] from OpenFOAM's field to out.flux, or from state.flux to the
// field.
void take_flux(const Foam::surfaceScalarField& phi, const std::vector<FacePlace>& places,
               FlowState& out);
void put_flux(const FlowState& state, const std::vector<FacePlace>& places,
              Foam::surfaceScalarField& phi);

}  // namespace magfsi::openfoam
