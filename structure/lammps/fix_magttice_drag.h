// fix ID group magttice/drag RATE: force = -RATE * mass * velocity on every atom of the
// group. LAMMPS's fix viscous has one coefficient an atom type, but nodes differ in mass.
#pragma once

#include "fix.h"

namespace magfsi::structure {

class FixMagtticeDrag : public LAMMPS_NS::Fix {
  public:
    FixMagtticeDrag(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override;
    void setup(int vflag) override { post_force(vflag); }
    void post_force(int vflag) override;

  private:
    double rate_1_s_ = 0;
};

}  // namespace magfsi::structure
