// What fix magttice/platform reports and the stick points that it keeps with the atoms.
#include "atom.h"

#include <cmath>
#include <cstring>

#include "structure/lammps/effects/platform/fix_magttice_platform.h"

namespace magfsi::structure {
namespace {

constexpr int stick_values = 4;

int pack(const StickPoint& stick, double* buffer) {
    for (int d = 0; d < 3; ++d) buffer[d] = stick.at_m[static_cast<std::size_t>(d)];
    buffer[3] = stick.held ? 1 : 0;
    return stick_values;
}

StickPoint unpack(const double* buffer) {
    return {{buffer[0], buffer[1], buffer[2]}, buffer[3] != 0};
}

}  // namespace

double FixMagtticePlatform::compute_scalar() {
    double all = 0;
    MPI_Allreduce(&energy_j_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

double FixMagtticePlatform::compute_vector(int i) {
    if (i == 3) {
        double smallest = 0;
        MPI_Allreduce(&smallest_gap_m_, &smallest, 1, MPI_DOUBLE, MPI_MIN, world);
        return smallest;
    }
    const std::array<double, 6> mine{normal_n_,   energy_j_,   force_n_[0],
                                     force_n_[1], force_n_[2], slid_j_};
    std::array<double, 6> all{};
    MPI_Allreduce(mine.data(), all.data(), 6, MPI_DOUBLE, MPI_SUM, world);
    if (i == 0) return all[0];
    if (i == 2) return all[1];
    if (i > 3) return all[static_cast<std::size_t>(i - 2)];
    double squared = 0;  // the part of the force that lies in the plane
    for (std::size_t d = 0; d < 3; ++d) {
        const double part = all[2 + d] - all[0] * platform_.normal[d];
        squared += part * part;
    }
    return std::sqrt(squared);
}

void* FixMagtticePlatform::extract(const char* name, int& dimension) {
    dimension = 0;
    return std::strcmp(name, "lost_share") == 0 ? &slid_j_ : nullptr;
}

void FixMagtticePlatform::grow_arrays(int count) {
    stick_.resize(static_cast<std::size_t>(count));
}

void FixMagtticePlatform::copy_arrays(int from, int to, int) {
    stick_[static_cast<std::size_t>(to)] = stick_[static_cast<std::size_t>(from)];
}

void FixMagtticePlatform::set_arrays(int atom_index) {
    stick_[static_cast<std::size_t>(atom_index)] = {};
}

int FixMagtticePlatform::pack_exchange(int i, double* buffer) {
    return pack(stick_[static_cast<std::size_t>(i)], buffer);
}

int FixMagtticePlatform::unpack_exchange(int i, double* buffer) {
    stick_[static_cast<std::size_t>(i)] = unpack(buffer);
    return stick_values;
}

// LAMMPS expects the number of values in the first one.
int FixMagtticePlatform::pack_restart(int i, double* buffer) {
    buffer[0] = stick_values + 1;
    return 1 + pack(stick_[static_cast<std::size_t>(i)], buffer + 1);
}

void FixMagtticePlatform::unpack_restart(int i, int nth) {
    const double* values = atom->extra[i];
    for (int skipped = 0; skipped < nth; ++skipped) values += static_cast<int>(*values);
    stick_[static_cast<std::size_t>(i)] = unpack(values + 1);
}

int FixMagtticePlatform::size_restart(int) {
    return stick_values + 1;
}

int FixMagtticePlatform::maxsize_restart() {
    return stick_values + 1;
}

double FixMagtticePlatform::memory_usage() {
    return static_cast<double>(stick_.size() * sizeof(StickPoint) +
                               surface_.size() * sizeof(SurfaceNode));
}

}  // namespace magfsi::structure
