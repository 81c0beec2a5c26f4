// fix ID group magfsi/fluid: the fluid's force on the nodes, evaluated in every time step
// of LAMMPS by the coupler's immersed boundary. Used by the coupled participant only.
#pragma once

#include <functional>

#include "fix.h"

namespace magfsi::lammps {

// velocity and force: three values a local or ghost atom; duration of the time step [s].
using NodalForce =
    std::function<void(const double* velocity, double* force, double step_s)>;

class FixFluidForce : public LAMMPS_NS::Fix {
  public:
    FixFluidForce(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

    int setmask() override;
    // After LAMMPS has cleared and computed forces and before it sums those of ghost
    // atoms: forces put on ghosts reach their owners.
    void pre_reverse(int, int) override;

    void attach(NodalForce nodal_force) { nodal_force_ = std::move(nodal_force); }

    static LAMMPS_NS::Fix* create(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  private:
    NodalForce nodal_force_;
};

}  // namespace magfsi::lammps
