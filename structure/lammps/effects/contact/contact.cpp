// SPDX-License-Identifier: GPL-2.0-or-later
// Contact between bodies as an effect of the script, and compute ID group
// magttice/contact, which reports its present state. See docs/fix_magttice.md.
#include "compute.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <fmt/format.h>

#include "structure/lammps/effects/contact/contact_pair.h"

namespace magfsi::structure {
namespace {

// State of the pair style magttice/contact. All functions are collective.
class ComputeMagtticeContact : public LAMMPS_NS::Compute {
  public:
    ComputeMagtticeContact(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    ~ComputeMagtticeContact() override;
    void init() override;
    double compute_scalar() override;  // energy [J]
    // Energy [J], number of touching pairs, smallest distance [m], energy lost to
    // friction [J]
    void compute_vector() override;

  private:
    PairMagtticeContact* pair_ = nullptr;
};

ComputeMagtticeContact::ComputeMagtticeContact(LAMMPS_NS::LAMMPS* lammps, int narg,
                                               char** arg)
    : Compute(lammps, narg, arg) {
    if (narg != 3) {
        fail(*error, "compute {} magttice/contact takes no argument", id);
    }
    scalar_flag = 1;
    extscalar = 1;
    vector_flag = 1;
    size_vector = 4;
    extvector = -1;
    extlist = new int[4]{1, 1, 0, 1};
    vector = new double[4]{};
}

ComputeMagtticeContact::~ComputeMagtticeContact() {
    delete[] vector;
    delete[] extlist;
}

void ComputeMagtticeContact::init() {
    pair_ = dynamic_cast<PairMagtticeContact*>(force->pair_match("magttice/contact", 1));
    if (pair_ == nullptr) {
        fail(*error, "compute {} magttice/contact needs the pair_style magttice/contact",
             id);
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
    MPI_Allreduce(&mine.slid_j, vector + 3, 1, MPI_DOUBLE, MPI_SUM, world);
}

// pair_coeff sets nothing but is required by LAMMPS.
void add_contact(Lines& lines, const LammpsInput& input) {
    const ContactLaw law = contact_law(input);
    lines.push_back(
        fmt::format("pair_style magttice/contact {:.17g} {:.17g} excluded {:.17g}",
                    law.distance_m, law.stiffness_pa_m, law.excluded));
    if (law.friction > 0) lines.back() += fmt::format(" friction {:.17g}", law.friction);
    lines.back() += periodic_words(input);
    lines.push_back("pair_coeff * *");
    lines.push_back("compute contact all magttice/contact");
}

}  // namespace

extern const Effect contact_effect{
    .name = "contact",
    .asked = [](const LammpsInput& input) { return input.contact.has_value(); },
    .commands = add_contact,
    .surface_spring_pa_m =
        [](const LammpsInput& input, const Body& body) {
            return contact_spring_pa_m(body, contact_law(input));
        },
    .register_styles =
        [](LAMMPS_NS::LAMMPS& lammps) {
            (*lammps.force->pair_map)["magttice/contact"] =
                [](LAMMPS_NS::LAMMPS* made_for) -> LAMMPS_NS::Pair* {
                return new PairMagtticeContact(made_for);
            };
            (*lammps.modify->compute_map)["magttice/contact"] =
                [](LAMMPS_NS::LAMMPS* made_for, int narg,
                   char** arg) -> LAMMPS_NS::Compute* {
                return new ComputeMagtticeContact(made_for, narg, arg);
            };
        }};

}  // namespace magfsi::structure
