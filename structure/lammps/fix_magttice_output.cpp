// What fix magttice reports and what it keeps over restarts.
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "utils.h"

#include <algorithm>
#include <cstring>

#include "structure/lammps/failure.h"
#include "structure/lammps/fix_magttice.h"

namespace magfsi::structure {

// Energies cost a second pass over the elements, so only those who ask pay for it.
void FixMagttice::compute_energies() {
    if (energies_known_) return;
    energies_known_ = true;
    energy_j_ = {};
    if (kernel_.size() > 0) {
        scratch_.assign(3 * static_cast<std::size_t>(atom->nlocal + atom->nghost), 0.0);
        energy_j_[0] =
            kernel_.add_forces_and_energy(atom->x[0], scratch_.data()).energy_j;
    }
    for (const auto& added : forces_) energy_j_[1] += added->energy_j();
}

void FixMagttice::add_elastic_forces(double* f) const {
    if (kernel_.size() > 0) kernel_.add_forces(atom->x[0], f);
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
    const double mine = i < 2    ? energy_j_[static_cast<std::size_t>(i)]
                        : i == 2 ? work_j_
                        : i == 3 ? smallest_j_
                                 : lost_j_;
    double all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, i == 3 ? MPI_MIN : MPI_SUM, world);
    return all;
}

int FixMagttice::modify_param(int narg, char** arg) {
    if (std::strcmp(arg[0], "work") != 0) return 0;
    if (narg < 2) fail(*error, std::string("fix_modify ") + id + " work needs one value");
    const double value = LAMMPS_NS::utils::numeric(FLERR, arg[1], false, lmp);
    work_j_ = comm->me == 0 ? value : 0.0;
    return 2;
}

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

void* FixMagttice::extract(const char* name, int& dimension) {
    dimension = 0;
    if (std::strcmp(name, "work_share") == 0) return &work_j_;
    if (std::strcmp(name, "lost_share") == 0) return &lost_j_;
    return nullptr;
}

double FixMagttice::memory_usage() {
    // Both the lattice and the packed batches hold about 50 numbers an element.
    return static_cast<double>(lattice_.elements.size() + kernel_.size()) * 50 *
           sizeof(double);
}

}  // namespace magfsi::structure
