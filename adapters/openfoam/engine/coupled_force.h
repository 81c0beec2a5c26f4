// The force on the fluid as one of OpenFOAM's sources of momentum (fvOption), handed to
// it from outside in every step, in balance with the pressure.
//
// pimpleFoam keeps velocities in cells and fluxes on faces. A source a that changes from
// cell to cell drives the flux through a face by the mean of its two cells, and the
// pressure holds that; in the cell, the pressure's gradient is the mean of its two faces.
// So of a layer of force along its normal, which pressure holds in full, a -
// mean(mean(a)) = -h^2 a''/4 is left over and moves the cells, though nothing flows
// through their faces. With the force of a sheet, three cells thick, that is a quarter of
// it: markers see the fluid follow a sheet that it leaks through. Here cells get the mean
// of what their faces get, and what is held on faces is held in cells: Francois et al.,
// J. Comput. Phys. 213 (2006) 141, for the same trouble with surface tension.
#pragma once

#include "fvOption.H"
#include "volFields.H"

namespace magfsi::openfoam {

class CoupledForce : public Foam::fv::option {
  public:
    explicit CoupledForce(const Foam::fvMesh& mesh);

    void addSup(Foam::fvMatrix<Foam::vector>& equation, const Foam::label field) override;

    // The whole equation of momentum, before it is solved.
    void constrain(Foam::fvMatrix<Foam::vector>& equation,
                   const Foam::label field) override;

    // After the velocity was corrected by the pressure.
    void correct(Foam::volVectorField& velocity) override;

    Foam::vectorField& acceleration() { return acceleration_.primitiveFieldRef(); }

  private:
    Foam::volVectorField acceleration_;
    Foam::tmp<Foam::volScalarField> response_;  // velocity by acceleration [s]
};

}  // namespace magfsi::openfoam
