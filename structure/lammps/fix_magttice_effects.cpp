// What fix magttice adds with `viscosity` and `gradient`.
#include "atom.h"
#include "utils.h"

#include "structure/lammps/fix_magttice.h"

namespace magfsi::structure {

void FixMagttice::parse_gradient(char** arg) {
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 9; ++i) {
        matrix(i / 3, i % 3) = LAMMPS_NS::utils::numeric(FLERR, arg[i], false, lmp);
    }
    Vec3 origin{};
    for (std::size_t d = 0; d < 3; ++d) {
        origin[d] = LAMMPS_NS::utils::numeric(FLERR, arg[9 + d], false, lmp);
    }
    gradient_.emplace(matrix, origin);
}

void FixMagttice::read_gradient(const LatticeFile& read) {
    gradient_elements_ =
        gradient_elements(read.nodes_m, read.elements, read.magnetization_a_m);
}

void FixMagttice::add_gradient() {
    gradient_energy_j_ =
        owned_gradient_elements_.empty()
            ? 0
            : add_gradient_forces(owned_gradient_elements_, owned_gradient_nodes_,
                                  *gradient_, atom->x[0], atom->f[0]);
}

// With the velocities of the half step, as explicit damping has to.
double FixMagttice::add_viscous() {
    if (viscous_->empty()) return 0;
    return viscous_->add_forces(atom->x[0], atom->v[0], atom->f[0]);
}

}  // namespace magfsi::structure
