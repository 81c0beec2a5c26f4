// The motion's state noted in memory, for coupled steps that are done again.
#include <algorithm>

#include "adapters/lammps/engine.h"
#include "adapters/lammps/keeping_fixes.h"
#include "adapters/lammps/lammps_exit.h"
#include "atom.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

namespace magfsi::lammps {

namespace {

void copy_out(const double* from, int atoms, std::vector<double>& to) {
    to.assign(from, from + 3 * static_cast<std::ptrdiff_t>(atoms));
}

}  // namespace

void Engine::keep(Snapshot& snapshot) const {
    const LAMMPS_NS::Atom& atom = *lammps_->atom;
    const int all = atom.nlocal + atom.nghost;
    snapshot.step = lammps_->update->ntimestep;
    copy_out(atom.x[0], all, snapshot.position);
    copy_out(atom.v[0], all, snapshot.velocity);
    copy_out(atom.f[0], atom.nlocal, snapshot.force);
    const auto fixes = keeping_fixes(*lammps_->modify);
    std::size_t width = 0;
    for (LAMMPS_NS::Fix* fix : fixes) width += kept_values(*fix);
    snapshot.kept.resize(width * static_cast<std::size_t>(atom.nlocal));
    double* at = snapshot.kept.data();
    for (int i = 0; i < atom.nlocal; ++i) {
        for (LAMMPS_NS::Fix* fix : fixes) at += fix->pack_exchange(i, at);
    }
    snapshot.sums = fix_sums();
}

void Engine::go_back(const Snapshot& snapshot) {
    const InsideLammps inside;
    LAMMPS_NS::Atom& atom = *lammps_->atom;
    // Commands to change the step look for what depends on time; here nothing may change
    // but the number.
    lammps_->update->ntimestep = snapshot.step;
    std::ranges::copy(snapshot.position, atom.x[0]);
    std::ranges::copy(snapshot.velocity, atom.v[0]);
    const auto fixes = keeping_fixes(*lammps_->modify);
    std::vector<double> kept = snapshot.kept;  // fixes read from memory they may write
    double* at = kept.data();
    for (int i = 0; i < atom.nlocal; ++i) {
        for (LAMMPS_NS::Fix* fix : fixes) at += fix->unpack_exchange(i, at);
    }
    look_again();
    std::ranges::copy(snapshot.force, atom.f[0]);
    put_fix_sums(snapshot.sums);
}

}  // namespace magfsi::lammps
