// compute ID group magttice/contact: what pair_style magttice/contact does at present.
#pragma once

#include "compute.h"

namespace magfsi::structure {

class PairMagtticeContact;

class ComputeMagtticeContact : public LAMMPS_NS::Compute {
  public:
    ComputeMagtticeContact(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    ~ComputeMagtticeContact() override;
    void init() override;
    double compute_scalar() override;  // energy
    void compute_vector() override;    // energy, touching pairs, smallest distance

  private:
    const PairMagtticeContact* pair_ = nullptr;
};

}  // namespace magfsi::structure
