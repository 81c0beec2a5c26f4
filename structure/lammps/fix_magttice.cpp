// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/fix_magttice.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "update.h"
#include "utils.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>

#include "base/words/path_word.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/material_words.h"
#include "structure/lammps/register_styles.h"
#include "structure/lattice/stiffening.h"
#include "structure/mesh/surface.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Number of the first keyword: after ID, group, style, file, first atom, G and K.
constexpr int first_keyword = 7;

}  // namespace

// fix ID group magttice FILE first_atom_id G K [element VARIANT] [field Bx By Bz] ...
FixMagttice::FixMagttice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg), who_(fmt::format("fix {} magttice", id)) {
    if (narg < first_keyword) {
        fail(*error, who_ + " needs a lattice file, its first atom ID, G and K");
    }
    range_.first_id = LAMMPS_NS::utils::inumeric(FLERR, arg[4], false, lmp);
    materials_.push_back(read_material({arg + 5, 2}, lmp));
    try {
        std::vector<AskedForce> forces;
        for (int i = first_keyword; i < narg;)
            i += parse_keyword(narg - i, arg + i, forces);
        const auto viscous = [](const Material& m) { return m.viscosity_pa_s != 0; };
        if (std::ranges::any_of(materials_, viscous))
            forces.push_back({body_force_style("viscosity"), nullptr});
        const auto branched = [](const Material& m) { return !m.branches.empty(); };
        if (std::ranges::any_of(materials_, branched))
            forces.push_back({body_force_style(force_of_branches), nullptr});
        read_body(words::path_of_word(arg[3]), forces);
    } catch (const std::exception& cause) {
        fail(*error, "{}: {}", who_, cause.what());
    }
    declare_output();
}

FixMagttice::~FixMagttice() {
    delete[] extlist;
    if (kept_ == 0) return;
    atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
    atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

// Force keywords are only collected: their forces need the lattice, which is read last.
int FixMagttice::parse_keyword(int left, char** arg, std::vector<AskedForce>& asked) {
    const std::string keyword = arg[0];
    const auto with = [&](int values) {
        if (left > values) return 1 + values;
        refuse("\"{}\" with {} values found, it takes {}", keyword, left - 1, values);
    };
    if (keyword == "element") {
        const int words = with(1);
        variant_ = parse_element_name(arg[1]);
        return words;
    }
    if (keyword == "viscosity") {
        const int words = with(1);
        materials_.front().viscosity_pa_s = number(arg[1], lmp);
        return words;
    }
    if (keyword == "material") {
        const int words = with(3);
        materials_.push_back(read_material({arg + 1, 3}, lmp));
        return words;
    }
    if (keyword == "branch") {
        const int words = with(2);
        materials_.back().branches.push_back({number(arg[1], lmp), number(arg[2], lmp)});
        return words;
    }
    if (keyword == "stiffening") {
        const std::span<char*> words(arg + 1, static_cast<std::size_t>(left - 1));
        return 1 + read_stiffening(words, materials_.back());
    }
    if (keyword == force_of_branches)
        refuse(
            "\"viscoelasticity\" found; the branches of a material are given by branch");
    const BodyForceStyle& found = body_force_style(keyword);
    const auto same = [&](const AskedForce& other) {
        return other.style.keyword == found.keyword;
    };
    if (std::ranges::any_of(asked, same)) refuse("\"{}\" found twice", keyword);
    asked.push_back({found, arg + 1});
    return with(found.values);
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
                             read.element_material, variant_, read.element_rigid);
    nodes_m_ = read.nodes_m;
    range_.count = static_cast<int>(read.nodes_m.size());
    by_first_.resize(read.nodes_m.size());
    for (std::size_t e = 0; e < read.elements.size(); ++e) {
        by_first_[read.elements[e][0]].push_back(e);
    }
    const MagtticeBody body{who_, range_, lattice_, nodes_m_, read.magnetization_a_m};
    for (const AskedForce& one : asked) {
        forces_.push_back(one.style.make(lmp, body, one.values));
        kept_ += forces_.back()->kept_values();
    }
    if (kept_ == 0) return;
    restart_peratom = 1;
    atom->add_callback(LAMMPS_NS::Atom::GROW);
    atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

int FixMagttice::setmask() {
    using namespace LAMMPS_NS::FixConst;
    // PRE_REVERSE is before the reverse communication, so that forces on ghosts reach
    // their owners.
    return PRE_REVERSE | MIN_PRE_REVERSE | POST_NEIGHBOR | MIN_POST_NEIGHBOR;
}

void FixMagttice::init() {
    if (force->newton == 0) fail(*error, who_ + " needs the command: newton on");
    if (atom->map_style == 0) {
        fail(*error, who_ + " needs the command: atom_modify map array");
    }
    if (std::string(update->integrate_style).find("respa") != std::string::npos) {
        fail(*error, who_ + " works with run_style verlet only");
    }
    // Forces are in newtons; other units of LAMMPS would scale them.
    if (std::strcmp(update->unit_style, "si") != 0)
        fail(*error, "{} found with units {}; allowed is units si", who_,
             update->unit_style);
    for (const FixMagttice* other : bodies_of(*modify)) {
        const NodeRange& its = other->range();
        if (other == this || its.first_id >= range_.first_id + range_.count ||
            range_.first_id >= its.first_id + its.count)
            continue;
        fail(*error,
             "{} and {} are both for atoms from ID {} on; an atom belongs to one body",
             who_, other->who_, std::max(its.first_id, range_.first_id));
    }
    int here = 0;
    for (int i = 0; i < atom->nlocal; ++i) here += range_.node(atom->tag[i]) >= 0 ? 1 : 0;
    int present = 0;
    MPI_Allreduce(&here, &present, 1, MPI_INT, MPI_SUM, world);
    if (present != range_.count) {
        fail(*error,
             "{} has {} nodes in its lattice file, but {} atoms with IDs from {} on are "
             "there",
             who_, range_.count, present, range_.first_id);
    }
    for (const auto& added : forces_) added->init();
}

// closest_image picks the copy of a node next to the element's first node, which matters
// across a periodic side.
OwnedElements FixMagttice::owned_elements() const {
    OwnedElements out;
    for (int i = 0; i < atom->nlocal; ++i) {
        const int node = range_.node(atom->tag[i]);
        if (node < 0) continue;
        for (int e : by_first_[node]) {
            std::array<int, 8> atoms{};
            for (int a = 0; a < 8; ++a) {
                const int atom_id = range_.first_id + lattice_.elements[e][a];
                const int seen = atom->map(atom_id);
                if (seen < 0) {
                    out.missing_id = atom_id;
                    return out;
                }
                atoms[a] = domain->closest_image(i, seen);
            }
            out.element.push_back(e);
            out.atom.push_back(atoms);
        }
    }
    return out;
}

void FixMagttice::rebuild() {
    const OwnedElements owned = owned_elements();
    if (owned.missing_id != 0) {
        fail(*error,
             "{}: atom {} of an element is not known on the rank that owns the element "
             "at step {}; raise comm_modify cutoff above the longest element diagonal "
             "({:g} m at rest)",
             who_, owned.missing_id, update->ntimestep, lattice_.longest_diagonal_m);
    }
    const OwnedElements soft = soft_ones(owned, lattice_);
    kernel_.assign(lattice_, soft.element, soft.atom);
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
        if (result.largest_share > largest_share_of_limit) refuse_tight(result);
    } else {
        smallest_j_ = INFINITY;
    }
    energies_known_ = false;
}

void FixMagttice::add_elastic_forces(double* f) const {
    if (kernel_.size() > 0) kernel_.add_forces(atom->x[0], f);
}

// The group's name is the body's. Positions that are NaN print as such.
std::string FixMagttice::place(int element) const {
    const Hexahedron& nodes = lattice_.elements[element];
    Vec3 rest{};
    Vec3 now{};
    for (int node : nodes) {
        const int i = atom->map(range_.first_id + node);
        for (std::size_t d = 0; d < 3; ++d) {
            rest[d] += 0.125 * nodes_m_[node][d];
            now[d] += 0.125 * (i < 0 ? NAN : atom->x[i][d]);
        }
    }
    return fmt::format(
        "body {}, centre now at ({:.6g}, {:.6g}, {:.6g}) m, in the body's frame at rest "
        "({:.6g}, {:.6g}, {:.6g}) m",
        group->names[igroup], now[0], now[1], now[2], rest[0], rest[1], rest[2]);
}

void FixMagttice::refuse_inverted(const KernelResult& result) {
    const std::string j = std::isinf(result.smallest_j)
                              ? "which is not a number"
                              : std::to_string(result.smallest_j);
    fail(*error,
         "{}: element {} is inverted at step {}, its volume ratio J is {} ({}); {}", who_,
         result.element, update->ntimestep, j, place(result.element), remedy());
}

void FixMagttice::refuse_tight(const KernelResult& result) {
    fail(*error,
         "{}: element {} is stretched to {:.3g} % of the limit of its material (of I1 - "
         "3) at step {}, {:.3g} % are allowed ({}); take weaker loads, a finer mesh or a "
         "material with a larger limit",
         who_, result.tight_element, 100 * result.largest_share, update->ntimestep,
         100 * largest_share_of_limit, place(result.tight_element));
}

// Across a periodic side the nodes of an element are those nearest to its first one,
// which are the wrong ones in a box of less than twice the element's length. Then no step
// helps.
std::string FixMagttice::remedy() const {
    for (std::size_t d = 0; d < 3; ++d) {
        if (domain->periodicity[d] == 0 ||
            domain->prd[d] > 2 * lattice_.longest_diagonal_m)
            continue;
        return fmt::format(
            "the box is periodic along {} and {:g} m long: give it more than {:g} m, "
            "twice the longest diagonal of an element, or boundary f or s there",
            "xyz"[d], domain -> prd[d], 2 * lattice_.longest_diagonal_m);
    }
    return advice_if_unstable();
}

// Energies cost a second pass over the elements and are computed only on request.
void FixMagttice::compute_energies() {
    if (energies_known_) return;
    energies_known_ = true;
    energy_j_ = {};
    if (kernel_.size() > 0) {
        scratch_.assign(3 * static_cast<std::size_t>(atom->nlocal + atom->nghost), 0.0);
        energy_j_[0] =
            kernel_.add_forces_and_energy(atom->x[0], scratch_.data()).energy_j;
    }
    for (const auto& added : forces_) {
        energy_j_[0] += added->stored_j();
        energy_j_[1] += added->energy_j();
    }
}

double FixMagttice::compute_scalar() {
    compute_energies();
    const double mine = energy_j_[0] + energy_j_[1];
    double sum = 0;
    MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
    return sum;
}

double FixMagttice::compute_vector(int i) {
    if (i < 2) compute_energies();
    const std::array<double, 5> mine{energy_j_[0], energy_j_[1], work_j_, smallest_j_,
                                     lost_j_};
    double all = 0;
    MPI_Allreduce(&mine[i], &all, 1, MPI_DOUBLE, i == 3 ? MPI_MIN : MPI_SUM, world);
    return all;
}

int FixMagttice::modify_param(int narg, char** arg) {
    if (std::strcmp(arg[0], "work") != 0) return 0;
    if (narg < 2) fail(*error, "fix_modify {} work needs one value", id);
    const double value = number(arg[1], lmp);
    work_j_ = comm->me == 0 ? value : 0.0;
    return 2;
}

void* FixMagttice::extract(const char* name, int& dimension) {
    dimension = 0;
    if (std::strcmp(name, "work_share") == 0) return &work_j_;
    if (std::strcmp(name, "lost_share") == 0) return &lost_j_;
    return nullptr;
}

double FixMagttice::memory_usage() {
    // Both the lattice and the packed batches hold about 50 numbers per element.
    return static_cast<double>(lattice_.elements.size() + kernel_.size()) * 50 *
           sizeof(double);
}

std::vector<const FixMagttice*> bodies_of(const LAMMPS_NS::Modify& modify) {
    std::vector<const FixMagttice*> out;
    for (int i = 0; i < modify.nfix; ++i) {
        if (std::strcmp(modify.fix[i]->style, "magttice") != 0) continue;
        out.push_back(static_cast<const FixMagttice*>(modify.fix[i]));
    }
    return out;
}

std::vector<SurfaceNode> surface_nodes(const LAMMPS_NS::Modify& modify) {
    std::vector<SurfaceNode> by_id;
    const auto bodies = bodies_of(modify);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const std::vector<Vec3>& x = bodies[b]->nodes_m();
        const auto areas = surface_areas(x, bodies[b]->lattice().elements);
        const std::size_t first = bodies[b]->range().first_id;
        by_id.resize(std::max(by_id.size(), first + x.size()));
        for (std::size_t a = 0; a < x.size(); ++a) {
            by_id[first + a] = {static_cast<int>(b), areas[a], x[a]};
        }
    }
    return by_id;
}

}  // namespace magfsi::structure
