#include "structure/lammps/effects/contact/compute_magttice_contact.h"

#include "error.h"
#include "force.h"
#include "update.h"

#include <string>

#include "structure/lammps/effects/contact/pair_magttice_contact.h"
#include "structure/lammps/failure.h"

namespace magfsi::structure {

ComputeMagtticeContact::ComputeMagtticeContact(LAMMPS_NS::LAMMPS* lammps, int narg,
                                               char** arg)
    : Compute(lammps, narg, arg) {
    if (narg != 3) {
        fail(*error,
             std::string("compute ") + id + " magttice/contact takes no argument");
    }
    scalar_flag = 1;
    extscalar = 1;
    vector_flag = 1;
    size_vector = 3;
    extvector = -1;
    extlist = new int[3]{1, 1, 0};
    vector = new double[3]{};
}

ComputeMagtticeContact::~ComputeMagtticeContact() {
    delete[] vector;
    delete[] extlist;
}

void ComputeMagtticeContact::init() {
    pair_ = dynamic_cast<const PairMagtticeContact*>(
        force->pair_match("magttice/contact", 1));
    if (pair_ == nullptr) {
        fail(*error, std::string("compute ") + id +
                         " magttice/contact needs the pair_style magttice/contact");
    }
}

double ComputeMagtticeContact::compute_scalar() {
    invoked_scalar = update->ntimestep;
    const double mine = pair_->state().energy_j;
    MPI_Allreduce(&mine, &scalar, 1, MPI_DOUBLE, MPI_SUM, world);
    return scalar;
}

void ComputeMagtticeContact::compute_vector() {
    invoked_vector = update->ntimestep;
    const PairMagtticeContact::State mine = pair_->state();
    const double sums[2] = {mine.energy_j, mine.touching};
    MPI_Allreduce(sums, vector, 2, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(&mine.smallest_m, vector + 2, 1, MPI_DOUBLE, MPI_MIN, world);
}

}  // namespace magfsi::structure
