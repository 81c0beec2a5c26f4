// SPDX-License-Identifier: GPL-2.0-or-later
// State of the atoms and fixes: for checkpoints by the atoms' IDs, for repeated steps in
// memory by their local indices.
#include <algorithm>
#include <string>

#include "adapters/solvers/lammps/engine.h"
#include "adapters/solvers/lammps/lammps_exit.h"
#include "atom.h"
#include "comm.h"
#include "coupler/checkpoint/rank_rows.h"
#include "fix.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "pair.h"
#include "structure/lammps/kept_pairs.h"
#include "update.h"

namespace magfsi::lammps {

namespace {

constexpr std::size_t motion_values = 9;  // position, velocity, force

// Fixes that keep values with their atoms which a restart needs.
std::vector<LAMMPS_NS::Fix*> keeping_fixes(const LAMMPS_NS::Modify& modify) {
    std::vector<LAMMPS_NS::Fix*> found;
    for (int i = 0; i < modify.nfix; ++i) {
        if (modify.fix[i]->restart_peratom != 0) found.push_back(modify.fix[i]);
    }
    return found;
}

// Number of values that a fix keeps with each atom: LAMMPS's record of them less the
// entry for its length.
std::size_t kept_values(LAMMPS_NS::Fix& fix) {
    return fix.maxsize_restart() - 1;
}

void copy_out(const double* from, int atoms, std::vector<double>& to) {
    to.assign(from, from + 3 * static_cast<std::ptrdiff_t>(atoms));
}

}  // namespace

// The pair style if it keeps values with pairs of atoms (contact with friction), else
// null.
structure::KeepsPairs* Engine::keeper() const {
    return dynamic_cast<structure::KeepsPairs*>(lammps_->force->pair);
}

std::vector<double> Engine::pairs() const {
    const structure::KeepsPairs* keeps = keeper();
    return keeps ? keeps->kept_pairs() : std::vector<double>{};
}

void Engine::put_pairs(std::span<const double> rows) {
    if (structure::KeepsPairs* keeps = keeper()) keeps->put_pairs(rows);
}

// The fix that moves rigid parts, else null.
structure::MovesRigidParts* Engine::rigid_parts() const {
    const LAMMPS_NS::Modify& modify = *lammps_->modify;
    for (int i = 0; i < modify.nfix; ++i) {
        if (auto* moves = dynamic_cast<structure::MovesRigidParts*>(modify.fix[i]))
            return moves;
    }
    return nullptr;
}

std::vector<structure::RigidPartMotion> Engine::rigid_motions() const {
    const structure::MovesRigidParts* parts = rigid_parts();
    return parts ? parts->motions() : std::vector<structure::RigidPartMotion>{};
}

std::vector<double> Engine::rigid_states() const {
    const structure::MovesRigidParts* parts = rigid_parts();
    return parts ? parts->states() : std::vector<double>{};
}

void Engine::put_rigid_states(std::span<const double> states) {
    if (structure::MovesRigidParts* parts = rigid_parts()) parts->put_states(states);
}

std::size_t Engine::node_values() const {
    std::size_t values = motion_values;
    for (LAMMPS_NS::Fix* fix : keeping_fixes(*lammps_->modify))
        values += kept_values(*fix);
    return values;
}

std::vector<double> Engine::gather_nodes(int atoms) const {
    const LAMMPS_NS::Atom& atom = *lammps_->atom;
    const std::size_t width = node_values();
    std::vector<int> index;
    std::vector<double> rows(width * atom.nlocal);
    for (int i = 0; i < atom.nlocal; ++i) {
        double* row = rows.data() + width * i;
        std::copy_n(atom.x[i], 3, row);
        std::copy_n(atom.v[i], 3, row + 3);
        std::copy_n(atom.f[i], 3, row + 6);
        double* at = row + motion_values;
        for (LAMMPS_NS::Fix* fix : keeping_fixes(*lammps_->modify))
            at += fix->pack_exchange(i, at);
        index.push_back(static_cast<int>(atom.tag[i]) - 1);
    }
    return coupler::gather_rows(comm_, index, rows, width, atoms);
}

void Engine::put_nodes(std::span<const double> rows) {
    const InsideLammps inside;
    LAMMPS_NS::Atom& atom = *lammps_->atom;
    const std::size_t width = node_values();
    const auto row_of = [&](int i) { return rows.data() + width * (atom.tag[i] - 1); };
    for (int i = 0; i < atom.nlocal; ++i) {
        std::copy_n(row_of(i), 3, atom.x[i]);
        std::copy_n(row_of(i) + 3, 3, atom.v[i]);
        std::vector<double> kept(row_of(i) + motion_values, row_of(i) + width);
        double* at = kept.data();
        for (LAMMPS_NS::Fix* fix : keeping_fixes(*lammps_->modify))
            at += fix->unpack_exchange(i, at);
    }
    lammps_->comm->forward_comm();
    evaluate_again();
    // Forces depend on velocities of a half step and on those of the fluid, which cannot
    // be evaluated again: the saved forces are restored.
    for (int i = 0; i < atom.nlocal; ++i) std::copy_n(row_of(i) + 6, 3, atom.f[i]);
}

// Lets every fix evaluate again what it keeps of the last evaluation (field, energies),
// at the positions just set. Calls the fixes one by one, for LAMMPS's Modify does so only
// within a run.
void Engine::evaluate_again() {
    for (int i = 0; i < lammps_->modify->nfix; ++i)
        lammps_->modify->fix[i]->setup_pre_reverse(0, 0);
}

// Pointers to this rank's shares of all sums over time, in an order that is the same in
// every run of the scene: those of the fixes, then that of the pair style.
std::vector<double*> Engine::sums_in_fixes() const {
    std::vector<double*> sums;
    for (int i = 0; i < lammps_->modify->nfix; ++i) {
        for (const char* name : {"work_share", "lost_share"}) {
            int dimension = 0;
            void* found = lammps_->modify->fix[i]->extract(name, dimension);
            if (found != nullptr) sums.push_back(static_cast<double*>(found));
        }
    }
    int dimension = 0;
    if (auto* pair = lammps_->force->pair)
        if (void* found = pair->extract("lost_share", dimension))
            sums.push_back(static_cast<double*>(found));
    return sums;
}

std::vector<double> Engine::fix_sums() const {
    std::vector<double> values;
    for (const double* sum : sums_in_fixes()) values.push_back(*sum);
    return values;
}

void Engine::put_fix_sums(std::span<const double> values) {
    std::size_t i = 0;
    for (double* sum : sums_in_fixes()) *sum = values[i++];
}

void Engine::start_at(std::int64_t lammps_step) {
    command("reset_timestep " + std::to_string(lammps_step));
}

// Positions and velocities include those of ghost atoms, which go_back then need not
// exchange.
void Engine::keep() {
    const LAMMPS_NS::Atom& atom = *lammps_->atom;
    const int all = atom.nlocal + atom.nghost;
    kept_.step = lammps_->update->ntimestep;
    copy_out(atom.x[0], all, kept_.position);
    copy_out(atom.v[0], all, kept_.velocity);
    copy_out(atom.f[0], atom.nlocal, kept_.force);
    const auto fixes = keeping_fixes(*lammps_->modify);
    std::size_t width = 0;
    for (LAMMPS_NS::Fix* fix : fixes) width += kept_values(*fix);
    kept_.of_fixes.resize(width * atom.nlocal);
    double* at = kept_.of_fixes.data();
    for (int i = 0; i < atom.nlocal; ++i) {
        for (LAMMPS_NS::Fix* fix : fixes) at += fix->pack_exchange(i, at);
    }
    kept_.sums = fix_sums();
    kept_.pairs = pairs();
    kept_.rigid = rigid_states();
}

void Engine::go_back() {
    const InsideLammps inside;
    LAMMPS_NS::Atom& atom = *lammps_->atom;
    // Sets the step number directly: the command reset_timestep also checks what depends
    // on time.
    lammps_->update->ntimestep = kept_.step;
    std::ranges::copy(kept_.position, atom.x[0]);
    std::ranges::copy(kept_.velocity, atom.v[0]);
    const auto fixes = keeping_fixes(*lammps_->modify);
    // A copy, since fixes read from memory that they may write to.
    std::vector<double> kept = kept_.of_fixes;
    double* at = kept.data();
    for (int i = 0; i < atom.nlocal; ++i) {
        for (LAMMPS_NS::Fix* fix : fixes) at += fix->unpack_exchange(i, at);
    }
    evaluate_again();
    std::ranges::copy(kept_.force, atom.f[0]);
    put_fix_sums(kept_.sums);
    put_pairs(kept_.pairs);
    put_rigid_states(kept_.rigid);
}

}  // namespace magfsi::lammps
