#include "structure/lammps/fix_magttice_quiet.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"
#include "modify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "structure/lammps/bodies.h"
#include "structure/lammps/failure.h"
#include "structure/lammps/fix_magttice.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {

FixMagtticeQuiet::FixMagtticeQuiet(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg != 3) {
        fail(*error, std::string("fix ") + id + " magttice/quiet takes no argument");
    }
    scalar_flag = 1;
    vector_flag = 1;
    size_vector = 2;
    extscalar = 0;
    extvector = 0;
    global_freq = 1;
    comm_reverse = 3;
}

QuietState FixMagtticeQuiet::state() {
    elastic_.assign(3 * static_cast<std::size_t>(atom->nlocal + atom->nghost), 0.0);
    for (const FixMagttice* body : bodies_of(*modify)) {
        body->add_elastic_forces(elastic_.data());
    }
    comm->reverse_comm_fix(this);
    let_go_of_reactions();
    std::array<double, 2> mine{};
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) == 0) continue;
        const double* f = atom->f[i];
        const double* elastic = &elastic_[3 * static_cast<std::size_t>(i)];
        mine[0] = std::max(mine[0], std::hypot(f[0], f[1], f[2]));
        mine[1] = std::max(
            mine[1], std::hypot(f[0] - elastic[0], f[1] - elastic[1], f[2] - elastic[2]));
    }
    std::array<double, 2> all{};
    MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_MAX, world);
    return {all[0], all[1]};
}

// On rollers the elastic force is the rollers' to balance, and no load. Clamped nodes are
// outside the group.
void FixMagtticeQuiet::let_go_of_reactions() {
    for (std::size_t d = 0; d < 3; ++d) {
        const int held = group->find(held_group(d).c_str());
        if (held < 0) continue;
        for (int i = 0; i < atom->nlocal; ++i) {
            if ((atom->mask[i] & group->bitmask[held]) != 0)
                elastic_[3 * static_cast<std::size_t>(i) + d] = atom->f[i][d];
        }
    }
}

double FixMagtticeQuiet::compute_vector(int i) {
    const QuietState now = state();
    return i == 0 ? now.largest_force_n : now.largest_load_n;
}

int FixMagtticeQuiet::pack_reverse_comm(int n, int first, double* buffer) {
    std::copy_n(&elastic_[3 * static_cast<std::size_t>(first)], 3 * n, buffer);
    return 3 * n;
}

void FixMagtticeQuiet::unpack_reverse_comm(int n, int* list, double* buffer) {
    for (int k = 0; k < n; ++k) {
        for (int d = 0; d < 3; ++d) {
            elastic_[static_cast<std::size_t>(3 * list[k] + d)] += *buffer++;
        }
    }
}

}  // namespace magfsi::structure
