// SPDX-License-Identifier: GPL-2.0-or-later
// Integrals over a plane across the box, on any mesh of polyhedra.
#pragma once

#include "adapters/solvers/openfoam/engine/engine.h"
#include "surfaceFields.H"
#include "volFields.H"

namespace magfsi::openfoam {

// Integrals over the plane across `axis` at the coordinate at_m, of all ranks. length_m:
// that of the box along the axis. Collective.
PlaneSums plane_sums(const Foam::volVectorField& velocity,
                     const Foam::volScalarField& pressure,
                     const Foam::surfaceScalarField& flux, int axis, double at_m,
                     double length_m);

}  // namespace magfsi::openfoam
