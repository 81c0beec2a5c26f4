// SPDX-License-Identifier: GPL-2.0-or-later
// The part of fix magttice that restart files and the exchange of atoms carry.
#include "atom.h"
#include "comm.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "structure/lammps/fix_magttice.h"

namespace magfsi::structure {

// Sums over all ranks, written by rank 0, which takes them back whole in restart().
void FixMagttice::write_restart(FILE* file) {
    const std::array<double, 2> totals{compute_vector(2), compute_vector(4)};
    if (comm->me != 0) return;
    const int size = sizeof(totals);
    std::fwrite(&size, sizeof(int), 1, file);
    std::fwrite(totals.data(), sizeof(totals), 1, file);
}

void FixMagttice::restart(char* buffer) {
    std::array<double, 2> totals{};
    std::memcpy(totals.data(), buffer, sizeof(totals));
    work_j_ = comm->me == 0 ? totals[0] : 0.0;
    lost_j_ = comm->me == 0 ? totals[1] : 0.0;
}

// Zeros for atoms of other bodies, since LAMMPS and checkpoints want rows of one width.
int FixMagttice::pack_exchange(int i, double* buffer) {
    std::fill_n(buffer, kept_, 0.0);
    const int node = range_.node(atom->tag[i]);
    for (const auto& added : forces_) {
        if (node >= 0) added->write_kept(node, buffer);
        buffer += added->kept_values();
    }
    return kept_;
}

int FixMagttice::unpack_exchange(int i, double* buffer) {
    const int node = range_.node(atom->tag[i]);
    for (const auto& added : forces_) {
        if (node >= 0) added->take_kept(node, buffer);
        buffer += added->kept_values();
    }
    return kept_;
}

// The first value of an atom's data is their number, as LAMMPS requires.
int FixMagttice::pack_restart(int i, double* buffer) {
    buffer[0] = size_restart(i);
    return 1 + pack_exchange(i, buffer + 1);
}

// Data of atom->extra: each fix has its own block, the nth of which is this one's.
void FixMagttice::unpack_restart(int i, int nth) {
    double* values = atom->extra[i];
    for (int skipped = 0; skipped < nth; ++skipped) values += static_cast<int>(*values);
    unpack_exchange(i, values + 1);
}

int FixMagttice::size_restart(int) {
    return 1 + kept_;
}

}  // namespace magfsi::structure
