// fix ID group magttice/drag RATE: every atom of the group is slowed at that rate,
// dv/dt = -RATE v. LAMMPS's fix viscous has one coefficient an atom type, but nodes
// differ in mass.
#pragma once

#include "fix.h"

namespace magfsi::structure {

class FixMagtticeDrag : public LAMMPS_NS::Fix {
  public:
    FixMagtticeDrag(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override;
    void init() override { reset_dt(); }
    void reset_dt() override;
    void initial_integrate(int) override { slow_down(); }
    void final_integrate() override { slow_down(); }

  private:
    void slow_down();

    double rate_1_s_ = 0;
    double half_step_factor_ = 1;  // exp(-rate dt / 2)
};

}  // namespace magfsi::structure
