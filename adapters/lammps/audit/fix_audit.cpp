#include "adapters/lammps/audit/fix_audit.h"

#include <cstring>

#include "atom.h"
#include "group.h"
#include "update.h"
#include "utils.h"

namespace magfsi::lammps {

FixAudit::FixAudit(LAMMPS_NS::LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words) {
    constexpr int first_value = 3;  // after ID, group and style
    rate_1_s_ = LAMMPS_NS::utils::numeric(FLERR, words[first_value], false, lmp);
    for (int i = first_value + 1; i < count; ++i)
        moved_bits_ |= group->bitmask[group->find(words[i])];
    vector_flag = 1;
    size_vector = 2;
    extvector = 1;
    global_freq = 1;
}

int FixAudit::setmask() {
    return LAMMPS_NS::FixConst::POST_INTEGRATE | LAMMPS_NS::FixConst::POST_FORCE;
}

// The drag takes RATE m v^2 of each node; its velocity of the half step is the mean.
void FixAudit::post_integrate() {
    if (rate_1_s_ > 0)
        lost_to_drag_j_ += 2 * rate_1_s_ * update->dt * kinetic_energy_j(false);
    if (moved_bits_ != 0) work_on_moved_j_ += 0.5 * update->dt * power_on_moved_w();
}

void FixAudit::post_force(int) {
    if (moved_bits_ != 0) work_on_moved_j_ += 0.5 * update->dt * power_on_moved_w();
}

bool FixAudit::moved(int atom_index) const {
    return (atom->mask[atom_index] & moved_bits_) != 0;
}

double FixAudit::power_on_moved_w() const {
    double sum = 0;
    for (int i = 0; i < atom->nlocal; ++i) {
        if (!moved(i)) continue;
        for (int d = 0; d < 3; ++d) sum += atom->f[i][d] * atom->v[i][d];
    }
    return sum;
}

double FixAudit::kinetic_energy_j(bool of_moved) const {
    double sum = 0;
    for (int i = 0; i < atom->nlocal; ++i) {
        if (moved(i) != of_moved) continue;
        const double* v = atom->v[i];
        sum += 0.5 * atom->rmass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return sum;
}

double FixAudit::compute_vector(int i) {
    double mine = lost_to_drag_j_;
    if (i == 0) mine = kinetic_energy_j(true) - work_on_moved_j_;
    double all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

void* FixAudit::extract(const char* name, int& dimension) {
    dimension = 0;
    if (std::strcmp(name, "work_share") == 0) return &work_on_moved_j_;
    if (std::strcmp(name, "lost_share") == 0) return &lost_to_drag_j_;
    return nullptr;
}

LAMMPS_NS::Fix* FixAudit::create(LAMMPS_NS::LAMMPS* lammps, int count, char** words) {
    return new FixAudit(lammps, count, words);
}

}  // namespace magfsi::lammps
