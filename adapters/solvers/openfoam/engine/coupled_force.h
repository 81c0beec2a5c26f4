// SPDX-License-Identifier: GPL-2.0-or-later
// The bodies' force in OpenFOAM's momentum equation.
#pragma once

#include "fvCFD.H"
#include "fvMatrices.H"
#include "fvOption.H"

namespace magfsi::openfoam {

// The coupling force on the fluid as an OpenFOAM momentum source (fvOption), set from
// outside before every step.
class CoupledForce : public Foam::fv::option {
  public:
    explicit CoupledForce(const Foam::fvMesh& mesh);

    // Adds the acceleration to the momentum equation.
    void addSup(Foam::fvMatrix<Foam::vector>& equation, const Foam::label field) override;

    Foam::vectorField& acceleration() { return acceleration_.primitiveFieldRef(); }

    // Replaces the acceleration in an equation that has been assembled with it by the
    // present one.
    void renew(Foam::fvMatrix<Foam::vector>& equation);

  protected:
    Foam::volVectorField acceleration_;

  private:
    Foam::vectorField in_equation_;  // the acceleration of the assembled equation
};

// The same, balanced with the pressure: for forces that are known before the step.
//
// pimpleFoam stores velocities in cells and fluxes on faces. An acceleration a that
// varies from cell to cell drives the flux through a face by the mean of its two cells,
// and the pressure balances that; in a cell, the pressure's gradient is the mean over its
// two faces. For a layer of force along its normal, which the pressure should balance in
// full, the residual a - mean(mean(a)) = -h^2 a''/4 accelerates the cells, though nothing
// flows through their faces. For the force of a sheet, three cells thick, that is a
// quarter of it: markers see the fluid follow a sheet that it leaks through. Here cells
// get the mean of what their faces get, so that a force balanced on faces is balanced in
// cells: Francois et al., J. Comput. Phys. 213 (2006) 141, for the same problem with
// surface tension.
//
// It must not be used where the force is found with the pressure until the cells move as
// the body does: the force would do another work on the cells than the body gives. Runs
// with the backward scheme gained energy from it until they diverged.
class BalancedForce final : public CoupledForce {
  public:
    using CoupledForce::CoupledForce;

    // Stores the response of the velocity, 1 / A, of the assembled momentum equation
    // before it is solved.
    void constrain(Foam::fvMatrix<Foam::vector>& equation,
                   const Foam::label field) override;

    // Replaces the cell value of the force's effect by the mean of its faces, after each
    // pressure correction of the velocity.
    void correct(Foam::volVectorField& velocity) override;

  private:
    Foam::tmp<Foam::volScalarField> response_;  // velocity over acceleration [s]
};

}  // namespace magfsi::openfoam
