#include "adapters/openfoam/engine/coupled_force.h"

#include "fvMatrices.H"

namespace magfsi::openfoam {

CoupledForce::CoupledForce(const Foam::fvMesh& mesh)
    : Foam::fv::option("coupledForce", "coupledForce", Foam::dictionary(), mesh),
      acceleration_(Foam::IOobject("coupledForce", mesh.time().timeName(), mesh), mesh,
                    Foam::dimensionedVector(Foam::dimAcceleration, Foam::Zero)) {
    fieldNames_.setSize(1, "U");
    applied_.setSize(1, false);
}

void CoupledForce::addSup(Foam::fvMatrix<Foam::vector>& equation, const Foam::label) {
    equation += acceleration_;
}

}  // namespace magfsi::openfoam
