// fix ID group magttice/quiet: the largest nodal force over the largest nodal load, for
// `fix halt`. See docs/fix_magttice.md.
#pragma once

#include "fix.h"

#include <vector>

#include "structure/lammps/quiet_state.h"

namespace magfsi::structure {

class FixMagtticeQuiet : public LAMMPS_NS::Fix {
  public:
    FixMagtticeQuiet(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override { return 0; }

    // Of the forces of the last step, all ranks together. Costs a pass over the elements
    // where it is asked for, and nothing else. Collective.
    QuietState state();
    double compute_scalar() override { return state().ratio(); }
    double compute_vector(int i) override;  // largest force, largest load [N]

    int pack_reverse_comm(int n, int first, double* buffer) override;
    void unpack_reverse_comm(int n, int* list, double* buffer) override;

  private:
    void let_go_of_reactions();

    std::vector<double> elastic_;  // three values an atom, local and ghost
};

}  // namespace magfsi::structure
