// fix ID group magttice/field PLANE COURSE ...: the field program as a global vector [T]
// of the present step's time. LAMMPS reads a variable's formula anew in every evaluation:
// a table written as one costs more than the forces of a small body.
#pragma once

#include "fix.h"

#include "structure/lammps/field_program.h"

namespace magfsi::structure {

class FixMagtticeFieldSource : public LAMMPS_NS::Fix {
  public:
    FixMagtticeFieldSource(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override { return 0; }
    double compute_vector(int i) override;

  private:
    FieldProgram program_;
};

}  // namespace magfsi::structure
