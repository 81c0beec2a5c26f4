// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/sticking_fix.h"

#include "atom.h"

namespace magfsi::structure {
namespace {

// Numbers that a stick point is packed into: place and state.
constexpr int stick_values = 4;

}  // namespace

StickingFix::~StickingFix() {
    if (each_ == 0) return;
    atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
    atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

void StickingFix::keep_sticks(int each) {
    each_ = each;
    restart_peratom = 1;
    grow_arrays(atom->nmax);
    atom->add_callback(LAMMPS_NS::Atom::GROW);
    atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

void StickingFix::grow_arrays(int count) {
    sticks_.resize(each_ * count);
}

void StickingFix::copy_arrays(int from, int to, int) {
    for (int n = 0; n < each_; ++n) stick(to, n) = stick(from, n);
}

void StickingFix::set_arrays(int atom_index) {
    for (int n = 0; n < each_; ++n) stick(atom_index, n) = {};
}

int StickingFix::pack_exchange(int i, double* buffer) {
    for (int n = 0; n < each_; ++n) {
        const StickPoint& point = stick(i, n);
        for (std::size_t d = 0; d < 3; ++d) *buffer++ = point.at_m[d];
        *buffer++ = point.held ? 1 : 0;
    }
    return each_ * stick_values;
}

int StickingFix::unpack_exchange(int i, double* buffer) {
    for (int n = 0; n < each_; ++n, buffer += stick_values)
        stick(i, n) = {{buffer[0], buffer[1], buffer[2]}, buffer[3] != 0};
    return each_ * stick_values;
}

// The first value of an atom's data is their number, as LAMMPS requires.
int StickingFix::pack_restart(int i, double* buffer) {
    buffer[0] = size_restart(i);
    return 1 + pack_exchange(i, buffer + 1);
}

// Data of atom->extra: each fix has its own block, the nth of which is this one's.
void StickingFix::unpack_restart(int i, int nth) {
    double* values = atom->extra[i];
    for (int skipped = 0; skipped < nth; ++skipped) values += static_cast<int>(*values);
    unpack_exchange(i, values + 1);
}

int StickingFix::size_restart(int) {
    return 1 + each_ * stick_values;
}

int StickingFix::maxsize_restart() {
    return 1 + each_ * stick_values;
}

double StickingFix::memory_usage() {
    return sticks_.size() * sizeof(StickPoint);
}

}  // namespace magfsi::structure
