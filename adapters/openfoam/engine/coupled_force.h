// The force on the fluid as one of OpenFOAM's sources of momentum (fvOption), handed to
// it from outside in every step.
#pragma once

#include "fvOption.H"
#include "volFields.H"

namespace magfsi::openfoam {

class CoupledForce : public Foam::fv::option {
  public:
    explicit CoupledForce(const Foam::fvMesh& mesh);

    void addSup(Foam::fvMatrix<Foam::vector>& equation, const Foam::label field) override;

    Foam::vectorField& acceleration() { return acceleration_.field(); }

  private:
    Foam::volVectorField::Internal acceleration_;
};

}  // namespace magfsi::openfoam
