// Kelvin-Voigt damping (structure/lattice/element.h).
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include "structure/lammps/body_force.h"
#include "structure/lammps/failure.h"
#include "structure/lammps/register_styles.h"
#include "structure/lattice/element_kernel.h"

namespace magfsi::structure {

namespace {

class ViscousForce : public BodyForce {
  public:
    ViscousForce(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body)
        : BodyForce(lammps), who_(body.who), lattice_(body.lattice) {
        // Refuses a viscosity that makes no sense before the run.
        kernel_.assign(lattice_);
    }

    void init() override {
        if (comm->ghost_velocity == 0) {
            fail(*error, who_ + " viscosity needs the command: comm_modify vel yes");
        }
    }
    void rebuild(const OwnedElements& owned) override {
        kernel_.assign(lattice_, owned.element, owned.atom);
    }
    void add() override { add_forces(); }
    // With the velocities of the half step, as explicit damping has to.
    Turnover advance() override { return {.lost_j = update->dt * add_forces()}; }
    void minimize() override {}

  private:
    double add_forces() {  // returns the power lost [W]
        if (kernel_.empty()) return 0;
        return kernel_.add_forces(atom->x[0], atom->v[0], atom->f[0]);
    }

    std::string who_;
    const Lattice& lattice_;
    ViscousKernel kernel_;
};

}  // namespace

void register_viscosity(LAMMPS_NS::LAMMPS&) {
    register_body_force("viscosity",
                        {0,
                         [](LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body,
                            char**) -> std::unique_ptr<BodyForce> {
                             return std::make_unique<ViscousForce>(lammps, body);
                         }});
}

}  // namespace magfsi::structure
