// SPDX-License-Identifier: GPL-2.0-or-later
// Kelvin-Voigt damping (structure/lattice/element_kernel.h): the forces of viscosity
// within fix magttice.
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>

#include "structure/body.h"
#include "structure/lammps/effect.h"
#include "structure/lattice/element_kernel.h"

namespace magfsi::structure {
namespace {

// Viscous forces on one body. Without the velocities of ghost atoms they would be wrong
// at the border between ranks.
class ViscousForce : public BodyForce {
  public:
    ViscousForce(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char**)
        : BodyForce(lammps), who_(body.who), lattice_(body.lattice) {
        kernel_.assign(lattice_);  // refuses a negative viscosity before the run
    }

    void init() override {
        if (comm->ghost_velocity == 0)
            fail(*error, who_ + " viscosity needs the command: comm_modify vel yes");
    }
    void rebuild(const OwnedElements& owned) override {
        const OwnedElements soft = soft_ones(owned, lattice_);
        kernel_.assign(lattice_, soft.element, soft.atom);
    }
    void add() override { add_forces(); }
    // The velocities are those of the half step, as explicit damping requires.
    Turnover advance() override { return {.lost_j = update->dt * add_forces()}; }
    // A minimiser looks for a rest state, which viscosity does not change.
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

// Viscosity of the body's own material. Those of other materials are among the words
// after `material`.
std::string viscosity_words(const LammpsInput&, const Body& body) {
    const double viscosity = body.material.viscosity_pa_s;
    return viscosity == 0 ? "" : fmt::format(" viscosity {:.17g}", viscosity);
}

}  // namespace

extern const Effect viscosity_effect{
    .name = "viscosity",
    .asked =
        [](const LammpsInput& input) {
            return std::ranges::any_of(input.bodies, is_viscous);
        },
    .body_words = viscosity_words,
    // fix magttice itself reads the value, which belongs to its first material.
    .force = {"viscosity", 0, make_force<ViscousForce>}};

}  // namespace magfsi::structure
