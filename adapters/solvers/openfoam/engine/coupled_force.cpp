// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/openfoam/engine/coupled_force.h"

#include "fvcFlux.H"
#include "fvcReconstruct.H"

namespace magfsi::openfoam {

CoupledForce::CoupledForce(const Foam::fvMesh& mesh)
    : Foam::fv::option("coupledForce", "coupledForce", Foam::dictionary(), mesh),
      acceleration_(Foam::IOobject("coupledForce", mesh.time().timeName(), mesh), mesh,
                    Foam::dimensionedVector(Foam::dimAcceleration, Foam::Zero)) {
    fieldNames_.setSize(1, "U");
    applied_.setSize(1, false);
}

void CoupledForce::addSup(Foam::fvMatrix<Foam::vector>& equation, const Foam::label) {
    equation += acceleration_();
    in_equation_ = acceleration_.primitiveField();
}

void CoupledForce::renew(Foam::fvMatrix<Foam::vector>& equation) {
    const Foam::vectorField& now = acceleration_.primitiveField();
    equation.source() += mesh_.V() * (now - in_equation_);
    in_equation_ = now;
}

void BalancedForce::constrain(Foam::fvMatrix<Foam::vector>& equation, const Foam::label) {
    response_ = 1 / equation.A();
}

void BalancedForce::correct(Foam::volVectorField& velocity) {
    Foam::volVectorField push(response_() * acceleration_);
    push.correctBoundaryConditions();  // values of neighbours on other ranks
    velocity += Foam::fvc::reconstruct(Foam::fvc::flux(push)) - push;
    velocity.correctBoundaryConditions();
}

}  // namespace magfsi::openfoam
