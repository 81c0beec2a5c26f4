// SPDX-License-Identifier: GPL-2.0-or-later
// Distance from equilibrium: fix ID group magttice/quiet gives the largest nodal force
// over the largest nodal load, for `fix halt`. See docs/fix_magttice.md.
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "structure/lammps/fix_magttice.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {
namespace {

// The fix has no work in a step; its values are computed on request, collectively.
class FixMagtticeQuiet : public LAMMPS_NS::Fix {
  public:
    FixMagtticeQuiet(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override { return 0; }

    // Largest force over largest load, of the last step and all ranks. Each call costs a
    // pass over the elements. Zero without any force; infinite if there is a force but no
    // load.
    double compute_scalar() override;
    // i = 0: largest force; 1: largest load [N]
    double compute_vector(int i) override;

    int pack_reverse_comm(int n, int first, double* buffer) override;
    void unpack_reverse_comm(int n, int* list, double* buffer) override;

  private:
    // Maxima over the nodes of the group. The force on a node is the sum that accelerates
    // it; the load is that sum without the elastic force (weight, field, contact, fluid).
    struct Largest {
        double force_n = 0;
        double load_n = 0;
    };
    Largest largest();
    // Takes the reactions of rollers out of the loads.
    void drop_reactions();

    std::vector<double> elastic_;  // three values per atom, local and ghost
};

FixMagtticeQuiet::FixMagtticeQuiet(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg != 3) fail(*error, "fix {} magttice/quiet takes no argument", id);
    scalar_flag = 1;
    vector_flag = 1;
    size_vector = 2;
    extscalar = 0;
    extvector = 0;
    global_freq = 1;
    comm_reverse = 3;
}

FixMagtticeQuiet::Largest FixMagtticeQuiet::largest() {
    elastic_.assign(3 * static_cast<std::size_t>(atom->nlocal + atom->nghost), 0.0);
    for (const FixMagttice* body : bodies_of(*modify)) {
        body->add_elastic_forces(elastic_.data());
    }
    sum_ghosts_onto_owners(*comm, static_cast<LAMMPS_NS::Fix*>(this));
    drop_reactions();
    std::array<double, 2> mine{};
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) == 0) continue;
        const Vec3 f = vector_at(atom->f[i]);
        const Vec3 elastic = vector_at(&elastic_[3 * static_cast<std::size_t>(i)]);
        mine[0] = std::max(mine[0], norm(f));
        mine[1] = std::max(mine[1], norm(f - elastic));
    }
    std::array<double, 2> all{};
    MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_MAX, world);
    return {all[0], all[1]};
}

// A roller balances the load along its axis, so that component is no load. (Clamped nodes
// are outside the group.)
void FixMagtticeQuiet::drop_reactions() {
    for (std::size_t d = 0; d < 3; ++d) {
        const int held = group->find(held_group(d).c_str());
        if (held < 0) continue;
        for (int i = 0; i < atom->nlocal; ++i) {
            if ((atom->mask[i] & group->bitmask[held]) != 0)
                elastic_[3 * static_cast<std::size_t>(i) + d] = atom->f[i][d];
        }
    }
}

double FixMagtticeQuiet::compute_scalar() {
    const Largest now = largest();
    return now.force_n > 0 ? now.force_n / now.load_n : 0;
}

double FixMagtticeQuiet::compute_vector(int i) {
    const Largest now = largest();
    return i == 0 ? now.force_n : now.load_n;
}

int FixMagtticeQuiet::pack_reverse_comm(int n, int first, double* buffer) {
    std::copy_n(&elastic_[3 * static_cast<std::size_t>(first)], 3 * n, buffer);
    return 3 * n;
}

void FixMagtticeQuiet::unpack_reverse_comm(int n, int* list, double* buffer) {
    for (int k = 0; k < n; ++k) {
        for (int d = 0; d < 3; ++d) {
            elastic_[3 * list[k] + d] += *buffer++;
        }
    }
}

void add_quiet(Lines& lines, const LammpsInput& input) {
    lines.push_back(fmt::format("fix quiet {} magttice/quiet", integrated_group(input)));
}

}  // namespace

extern const Effect quiet_effect{
    .name = "quiet",
    .asked = [](const LammpsInput& input) { return input.quiet; },
    .commands = add_quiet,
    .fix = {"magttice/quiet", make_fix<FixMagtticeQuiet>}};

}  // namespace magfsi::structure
