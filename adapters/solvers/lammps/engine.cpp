// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/engine.h"

#include <stdexcept>

#include "adapters/solvers/lammps/lammps_exit.h"
#include "atom.h"
#include "comm.h"
#include "coupler/checkpoint/rank_rows.h"
#include "coupler/participants/errors.h"
#include "fix.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "structure/lammps/register_styles.h"
#include "update.h"

namespace magfsi::lammps {

namespace {

using LAMMPS_NS::LAMMPS;

// LAMMPS without output to the screen. It keeps the pointers to its arguments only while
// it is constructed.
std::unique_ptr<LAMMPS> make_lammps(MPI_Comm comm, const std::string& log) {
    std::vector<std::string> words{"lammps", "-screen", "none", "-log", log, "-nocite"};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    return std::make_unique<LAMMPS>(static_cast<int>(pointers.size()), pointers.data(),
                                    comm);
}

}  // namespace

Engine::Engine(MPI_Comm comm, const std::filesystem::path& log) : comm_(comm) {
    watch_lammps_exit(log);
    const InsideLammps inside;
    lammps_ = make_lammps(comm, log.string());
    structure::register_styles(*lammps_);
}

Engine::~Engine() = default;

void Engine::command(const std::string& line) {
    const InsideLammps inside;
    lammps_->input->one(line);
}

// A run of no steps computes the forces and builds the neighbour lists.
void Engine::set_up() {
    command("run 0");
}

// The words `pre no` skip the set-up of a run: forces and layout of the step before are
// still valid.
void Engine::take_steps(int steps) {
    command("run " + std::to_string(steps) + " pre no post no");
}

// Writes to LAMMPS's variables directly: its command reset_timestep also checks what
// depends on time, and its command timestep may leave the fixes uninformed.
void Engine::divide_step(int factor) {
    LAMMPS_NS::Update& update = *lammps_->update;
    update.ntimestep *= factor;
    update.dt /= factor;
    for (int i = 0; i < lammps_->modify->nfix; ++i) lammps_->modify->fix[i]->reset_dt();
}

int Engine::local_index(int atom_id) const {
    return lammps_->atom->map(atom_id);
}

bool Engine::owns(int atom_id) const {
    const int local = local_index(atom_id);
    return local >= 0 && local < lammps_->atom->nlocal;
}

const double* Engine::positions() const {
    return lammps_->atom->x[0];
}
const double* Engine::velocities() const {
    return lammps_->atom->v[0];
}

void Engine::renew_ghost_velocities() {
    const InsideLammps inside;
    lammps_->comm->forward_comm();
}

void Engine::check_finite(std::int64_t step) const {
    const LAMMPS_NS::Atom& atom = *lammps_->atom;
    if (atom.nlocal == 0) return;
    const std::span<const double> all(atom.x[0],
                                      3 * static_cast<std::size_t>(atom.nlocal));
    if (all_finite(all)) return;
    int i = 0;
    while (all_finite(all.subspan(3 * static_cast<std::size_t>(i), 3))) ++i;
    throw coupler::Diverged("the structure diverged: node " +
                            std::to_string(atom.tag[i]) +
                            " has no finite position at step " + std::to_string(step) +
                            "; " + structure::advice_if_unstable());
}

// Sends one row of seven numbers for each local atom to the root.
NodalState Engine::gather(int atoms) const {
    constexpr std::size_t width = 7;  // position, velocity, mass
    const LAMMPS_NS::Atom& atom = *lammps_->atom;
    std::vector<int> index;
    std::vector<double> mine;
    for (int i = 0; i < atom.nlocal; ++i) {
        index.push_back(static_cast<int>(atom.tag[i]) - 1);
        mine.insert(mine.end(), atom.x[i], atom.x[i] + 3);
        mine.insert(mine.end(), atom.v[i], atom.v[i] + 3);
        mine.push_back(atom.rmass[i]);
    }
    const auto all = coupler::gather_rows(comm_, index, mine, width, atoms);
    NodalState state;
    for (std::size_t i = 0; i < all.size(); i += width) {
        state.position_m.push_back({all[i], all[i + 1], all[i + 2]});
        state.velocity_m_s.push_back({all[i + 3], all[i + 4], all[i + 5]});
        state.mass_kg.push_back(all[i + 6]);
    }
    if (!all.empty()) state.rigid = rigid_motions();
    return state;
}

// Fix before_rollers, which the script has with reactions, keeps the forces before fix
// rollers sets components of them to zero.
std::vector<Vec3> Engine::gather_forces(int atoms) const {
    const LAMMPS_NS::Atom& atom = *lammps_->atom;
    const int kept = lammps_->modify->find_fix("before_rollers");
    const double* const* const force =
        kept < 0 ? atom.f : lammps_->modify->fix[kept]->array_atom;
    std::vector<double> mine;
    for (int i = 0; i < atom.nlocal; ++i) mine.insert(mine.end(), force[i], force[i] + 3);
    return gather_vectors(atoms, mine);
}

std::vector<Vec3> Engine::gather_contact_forces(int atoms) const {
    int dimension = 0;
    const auto* const force = static_cast<const double*>(
        lammps_->modify->fix[fix_number("contact_load")]->extract("contact_force",
                                                                  dimension));
    return gather_vectors(atoms, {force, force + 3 * lammps_->atom->nlocal});
}

// mine: three values for each of this rank's atoms.
std::vector<Vec3> Engine::gather_vectors(int atoms,
                                         const std::vector<double>& mine) const {
    const LAMMPS_NS::Atom& atom = *lammps_->atom;
    std::vector<int> index;
    for (int i = 0; i < atom.nlocal; ++i)
        index.push_back(static_cast<int>(atom.tag[i]) - 1);
    const auto all = coupler::gather_rows(comm_, index, mine, 3, atoms);
    std::vector<Vec3> out(all.size() / 3);
    std::copy(all.begin(), all.end(), out.empty() ? nullptr : out.front().data());
    return out;
}

std::string Engine::version() const {
    return lammps_->version;
}

int Engine::fix_number(const std::string& fix_id) const {
    const int at = lammps_->modify->find_fix(fix_id);
    if (at < 0) throw std::logic_error("LAMMPS has no fix '" + fix_id + "'");
    return at;
}

double Engine::fix_vector(const std::string& fix_id, int n) const {
    return lammps_->modify->fix[fix_number(fix_id)]->compute_vector(n - 1);
}

double Engine::fix_scalar(const std::string& fix_id) const {
    return lammps_->modify->fix[fix_number(fix_id)]->compute_scalar();
}

}  // namespace magfsi::lammps
