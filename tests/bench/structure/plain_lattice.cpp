#include "tests/bench/structure/plain_lattice.h"

#include "atom.h"

#include <stdexcept>
#include <string>

#include "structure/lammps/lattice_file.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure::bench {

PlainLattice::PlainLattice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg != 7) throw std::invalid_argument("fix bench/plain takes four arguments");
    const LatticeFile file = read_lattice_file(arg[3]);
    material_.shear_modulus_pa = std::stod(arg[4]);
    material_.lame_lambda_pa = std::stod(arg[5]);
    elements_ = file.elements;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        reference_.push_back(element_reference(gather(file.nodes_m, elements_[e]),
                                               parse_element_name(arg[6]),
                                               static_cast<int>(e)));
    }
}

int PlainLattice::setmask() {
    return LAMMPS_NS::FixConst::PRE_REVERSE;
}

// One rank: every node is a local atom.
void PlainLattice::add_forces() {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        std::array<int, 8> atoms{};
        Positions8 x;
        for (int a = 0; a < 8; ++a) {
            atoms[static_cast<std::size_t>(a)] =
                atom->map(elements_[e][static_cast<std::size_t>(a)] + 1);
            for (int d = 0; d < 3; ++d) {
                x(a, d) = atom->x[atoms[static_cast<std::size_t>(a)]][d];
            }
        }
        const ElementState state = element_energy(reference_[e], material_, x);
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) {
                atom->f[atoms[static_cast<std::size_t>(a)]][d] += state.force_n(a, d);
            }
        }
    }
}

}  // namespace magfsi::structure::bench
