#include "force.h"
#include "modify.h"

#include "structure/lammps/effects/contact/compute_magttice_contact.h"
#include "structure/lammps/effects/contact/pair_magttice_contact.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/style_creator.h"

namespace magfsi::structure {

namespace {

LAMMPS_NS::Pair* create_contact(LAMMPS_NS::LAMMPS* lammps) {
    return new PairMagtticeContact(lammps);
}

}  // namespace

void register_contact(LAMMPS_NS::LAMMPS& lammps) {
    (*lammps.force->pair_map)["magttice/contact"] = &create_contact;
    (*lammps.modify->compute_map)["magttice/contact"] =
        &create<ComputeMagtticeContact, LAMMPS_NS::Compute>;
}

}  // namespace magfsi::structure
