// fix ID group bench/plain FILE G K ELEMENT: the forces of fix magttice, element by
// element in the plainest form (tests/unit/structure/plain_element.h). What the fast
// kernel is measured against.
#pragma once

#include "fix.h"

#include <array>
#include <vector>

#include "structure/lammps/lattice_file.h"
#include "tests/unit/structure/plain_element.h"

namespace magfsi::structure::bench {

class PlainLattice : public LAMMPS_NS::Fix {
  public:
    PlainLattice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override;
    void setup_pre_reverse(int, int) override { add_forces(); }
    void pre_reverse(int, int) override { add_forces(); }

  private:
    void add_forces();

    Material material_;
    std::vector<Hexahedron> elements_;  // node n is atom n + 1
    std::vector<ElementReference> reference_;
};

}  // namespace magfsi::structure::bench
