#include "structure/lammps/fix_magttice.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "structure/lammps/element_name.h"
#include "structure/lammps/failure.h"
#include "structure/lammps/lattice_file.h"
#include "structure/magnetics/nodal_charge.h"

namespace magfsi::structure {
namespace {

// ID group style, then the file, the first atom, G and K.
constexpr int first_keyword = 7;

}  // namespace

// fix ID group magttice FILE first_atom_id G K [element VARIANT] [field Bx By Bz]
FixMagttice::FixMagttice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg < first_keyword) {
        fail(*error, std::string("fix ") + id +
                         " magttice needs a lattice file, its first atom ID, G and K");
    }
    range_.first_id = LAMMPS_NS::utils::inumeric(FLERR, arg[4], false, lmp);
    Material material;
    material.shear_modulus_pa = LAMMPS_NS::utils::numeric(FLERR, arg[5], false, lmp);
    material.lame_lambda_pa = LAMMPS_NS::utils::numeric(FLERR, arg[6], false, lmp);
    ElementVariant variant = ElementVariant::full;
    for (int i = first_keyword; i < narg;) {
        const std::string keyword = arg[i];
        if (keyword == "element" && i + 1 < narg) {
            try {
                variant = parse_element_name(arg[i + 1]);
            } catch (const std::exception& cause) {
                fail(*error, std::string("fix ") + id + " magttice: " + cause.what());
            }
            i += 2;
        } else if (keyword == "field" && i + 3 < narg) {
            parse_field(arg + i + 1);
            i += 4;
        } else {
            fail(*error, std::string("fix ") + id + " magttice: \"" + keyword +
                             "\" found; \"element\" with one value and \"field\" with "
                             "three are allowed");
        }
    }
    try {
        read_body(arg[3], material, variant);
    } catch (const std::exception& cause) {
        fail(*error, std::string("fix ") + id + " magttice: " + cause.what());
    }
    declare_output();
}

FixMagttice::~FixMagttice() {
    delete[] extlist;
}

void FixMagttice::declare_output() {
    scalar_flag = 1;
    extscalar = 1;
    vector_flag = 1;
    size_vector = 4;
    extvector = -1;
    extlist = new int[4]{1, 1, 1, 0};
    global_freq = 1;
    energy_global_flag = 1;
    thermo_energy = 1;
    restart_global = 1;
}

void FixMagttice::read_body(const std::string& file, const Material& material,
                            ElementVariant variant) {
    const LatticeFile read = read_lattice_file(file);
    lattice_ = build_lattice(read.nodes_m, read.elements, material, variant);
    nodes_m_ = read.nodes_m;
    range_.count = static_cast<int>(read.nodes_m.size());
    by_first_.resize(read.nodes_m.size());
    for (std::size_t e = 0; e < read.elements.size(); ++e) {
        by_first_[static_cast<std::size_t>(read.elements[e][0])].push_back(
            static_cast<int>(e));
    }
    if (has_field_) {
        charge_a_m_ = nodal_charges(read.nodes_m, read.elements, read.magnetization_a_m);
    }
}

int FixMagttice::setmask() {
    using namespace LAMMPS_NS::FixConst;
    // Forces before the reverse communication, so that those on ghosts reach their
    // owners.
    return PRE_REVERSE | MIN_PRE_REVERSE | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
}

void FixMagttice::init() {
    const std::string who = std::string("fix ") + id + " magttice ";
    if (force->newton == 0) fail(*error, who + "needs the command: newton on");
    if (atom->map_style == 0) {
        fail(*error, who + "needs the command: atom_modify map array");
    }
    if (std::string(update->integrate_style).find("respa") != std::string::npos) {
        fail(*error, who + "works with run_style verlet only");
    }
    int here = 0;
    for (int i = 0; i < atom->nlocal; ++i) here += range_.node(atom->tag[i]) >= 0 ? 1 : 0;
    int present = 0;
    MPI_Allreduce(&here, &present, 1, MPI_INT, MPI_SUM, world);
    if (present != range_.count) {
        fail(*error, who + "has " + std::to_string(range_.count) +
                         " nodes in its lattice file, but " + std::to_string(present) +
                         " atoms with IDs from " + std::to_string(range_.first_id) +
                         " on are there");
    }
    init_field();
}

void FixMagttice::rebuild() {
    const OwnedElements owned =
        owned_elements(range_, lattice_.elements, by_first_, *atom, *domain);
    if (owned.missing_id != 0) {
        fail(*error,
             std::string("fix ") + id + " magttice: atom " +
                 std::to_string(owned.missing_id) +
                 " of an element is not known on the rank that owns the element at "
                 "step " +
                 std::to_string(update->ntimestep) +
                 "; raise comm_modify cutoff above the longest element diagonal (" +
                 std::to_string(lattice_.longest_diagonal_m) + " at rest)");
    }
    kernel_.assign(lattice_, owned.element, owned.atom);
    if (has_field_) charged_ = owned_charges(range_, charge_a_m_, *atom);
}

void FixMagttice::setup_pre_reverse(int, int) {
    if (has_field_) evaluate_field();
    add_forces();
}

void FixMagttice::min_pre_reverse(int, int) {
    if (has_field_) evaluate_field();
    add_forces();
}

void FixMagttice::pre_reverse(int, int) {
    if (has_field_) advance_field();
    add_forces();
}

void FixMagttice::add_forces() {
    if (kernel_.size() > 0) {
        const KernelResult result = kernel_.add_forces(atom->x[0], atom->f[0]);
        smallest_j_ = result.smallest_j;
        if (!(result.smallest_j > 0)) refuse_inverted(result);
    } else {
        smallest_j_ = INFINITY;
    }
    energies_known_ = false;
    double* const* const f = atom->f;
    for (const ChargedNode& node : charged_) {
        for (int d = 0; d < 3; ++d)
            f[node.atom][d] += node.charge_a_m * field_[d].value_t;
    }
}

void FixMagttice::refuse_inverted(const KernelResult& result) {
    const std::string j = std::isinf(result.smallest_j)
                              ? "which is not a number"
                              : std::to_string(result.smallest_j);
    fail(*error, std::string("fix ") + id + " magttice: element " +
                     std::to_string(result.element) + " is inverted at step " +
                     std::to_string(update->ntimestep) + ", its volume ratio J is " + j +
                     "; use a smaller time step, a finer mesh or a weaker field");
}

}  // namespace magfsi::structure
