#include "structure/lammps/fix_magttice.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "structure/lammps/element_name.h"
#include "structure/lammps/failure.h"
#include "structure/lammps/lattice_file.h"

namespace magfsi::structure {
namespace {

// ID group style, then the file, the first atom, G and K.
constexpr int first_keyword = 7;

}  // namespace

// fix ID group magttice FILE first_atom_id G K [element VARIANT] [field Bx By Bz] ...
FixMagttice::FixMagttice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg < first_keyword) {
        fail(*error, std::string("fix ") + id +
                         " magttice needs a lattice file, its first atom ID, G and K");
    }
    range_.first_id = LAMMPS_NS::utils::inumeric(FLERR, arg[4], false, lmp);
    Material& material = materials_.emplace_back();
    material.shear_modulus_pa = LAMMPS_NS::utils::numeric(FLERR, arg[5], false, lmp);
    material.lame_lambda_pa = LAMMPS_NS::utils::numeric(FLERR, arg[6], false, lmp);
    try {
        std::vector<AskedForce> forces;
        for (int i = first_keyword; i < narg;)
            i += parse_keyword(narg - i, arg + i, forces);
        const auto viscous = [](const Material& m) { return m.viscosity_pa_s != 0; };
        if (std::ranges::any_of(materials_, viscous))
            forces.push_back({body_force("viscosity"), nullptr});
        read_body(arg[3], forces);
    } catch (const std::exception& cause) {
        fail(*error, std::string("fix ") + id + " magttice: " + cause.what());
    }
    declare_output();
}

// Returns the number of words of the keyword and its values.
int FixMagttice::parse_keyword(int left, char** arg, std::vector<AskedForce>& asked) {
    const std::string keyword = arg[0];
    const auto with = [&](int values) {
        if (left > values) return 1 + values;
        throw std::invalid_argument("\"" + keyword + "\" with " +
                                    std::to_string(left - 1) +
                                    " values found, it takes " + std::to_string(values));
    };
    if (keyword == "element") {
        const int words = with(1);
        variant_ = parse_element_name(arg[1]);
        return words;
    }
    if (keyword == "viscosity") {
        const int words = with(1);
        materials_.front().viscosity_pa_s =
            LAMMPS_NS::utils::numeric(FLERR, arg[1], false, lmp);
        return words;
    }
    if (keyword == "material") {
        const int words = with(3);
        parse_material(arg + 1);
        return words;
    }
    const BodyForceStyle& found = body_force(keyword);
    for (const AskedForce& other : asked) {
        if (other.style.make == found.make)
            throw std::invalid_argument("\"" + keyword + "\" found twice");
    }
    asked.push_back({found, arg + 1});
    return with(found.values);
}

void FixMagttice::parse_material(char** arg) {
    Material& material = materials_.emplace_back();
    material.shear_modulus_pa = LAMMPS_NS::utils::numeric(FLERR, arg[0], false, lmp);
    material.lame_lambda_pa = LAMMPS_NS::utils::numeric(FLERR, arg[1], false, lmp);
    material.viscosity_pa_s = LAMMPS_NS::utils::numeric(FLERR, arg[2], false, lmp);
}

FixMagttice::~FixMagttice() {
    delete[] extlist;
}

void FixMagttice::declare_output() {
    scalar_flag = 1;
    extscalar = 1;
    vector_flag = 1;
    size_vector = 5;
    extvector = -1;
    extlist = new int[5]{1, 1, 1, 0, 1};
    global_freq = 1;
    energy_global_flag = 1;
    thermo_energy = 1;
    restart_global = 1;
}

void FixMagttice::read_body(const std::string& file,
                            const std::vector<AskedForce>& asked) {
    LatticeFile read = read_lattice_file(file);
    if (read.element_material.empty() && materials_.size() > 1) {
        read.element_material.assign(read.elements.size(), 0);
    }
    lattice_ = build_lattice(read.nodes_m, read.elements, materials_,
                             read.element_material, variant_);
    nodes_m_ = read.nodes_m;
    range_.count = static_cast<int>(read.nodes_m.size());
    by_first_.resize(read.nodes_m.size());
    for (std::size_t e = 0; e < read.elements.size(); ++e) {
        by_first_[static_cast<std::size_t>(read.elements[e][0])].push_back(
            static_cast<int>(e));
    }
    const MagtticeBody body{std::string("fix ") + id + " magttice", range_, lattice_,
                            nodes_m_, read.magnetization_a_m};
    for (const AskedForce& one : asked)
        forces_.push_back(one.style.make(lmp, body, one.values));
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
    for (const auto& added : forces_) added->init();
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
    for (const auto& added : forces_) added->rebuild(owned);
}

void FixMagttice::setup_pre_reverse(int, int) {
    add_elastic();
    for (const auto& added : forces_) added->add();
}

void FixMagttice::min_pre_reverse(int, int) {
    add_elastic();
    for (const auto& added : forces_) added->minimize();
}

void FixMagttice::pre_reverse(int, int) {
    add_elastic();
    for (const auto& added : forces_) {
        const BodyForce::Turnover step = added->advance();
        work_j_ += step.work_j;
        lost_j_ += step.lost_j;
    }
}

void FixMagttice::add_elastic() {
    if (kernel_.size() > 0) {
        const KernelResult result = kernel_.add_forces(atom->x[0], atom->f[0]);
        smallest_j_ = result.smallest_j;
        if (!(result.smallest_j > 0)) refuse_inverted(result);
    } else {
        smallest_j_ = INFINITY;
    }
    energies_known_ = false;
}

// The body is named as its group is. Positions that are not numbers print as such.
std::string FixMagttice::place(int element) const {
    const Hexahedron& nodes = lattice_.elements[static_cast<std::size_t>(element)];
    Vec3 rest{};
    Vec3 now{};
    for (int node : nodes) {
        const int i = atom->map(range_.first_id + node);
        for (std::size_t d = 0; d < 3; ++d) {
            rest[d] += 0.125 * nodes_m_[static_cast<std::size_t>(node)][d];
            now[d] += 0.125 * (i < 0 ? NAN : atom->x[i][d]);
        }
    }
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  "body %s, centre now at (%.6g, %.6g, %.6g) m, in the body's frame at "
                  "rest (%.6g, %.6g, %.6g) m",
                  group->names[igroup], now[0], now[1], now[2], rest[0], rest[1],
                  rest[2]);
    return text.data();
}

void FixMagttice::refuse_inverted(const KernelResult& result) {
    const std::string j = std::isinf(result.smallest_j)
                              ? "which is not a number"
                              : std::to_string(result.smallest_j);
    fail(*error, std::string("fix ") + id + " magttice: element " +
                     std::to_string(result.element) + " is inverted at step " +
                     std::to_string(update->ntimestep) + ", its volume ratio J is " + j +
                     " (" + place(result.element) +
                     "); use a smaller time step, a finer mesh or a weaker field");
}

}  // namespace magfsi::structure
