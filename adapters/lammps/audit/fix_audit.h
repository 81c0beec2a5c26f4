// fix ID group magfsi/audit RATE [MOVED_GROUP ...]: what no other fix tells of the energy
// of a step. Used only by runs with probes.energy_audit, after all fixes that add forces.
#pragma once

#include <vector>

#include "fix.h"

namespace magfsi::lammps {

class FixAudit : public LAMMPS_NS::Fix {
  public:
    // RATE: that of fix magttice/drag, or 0; groups of fixes magttice/motion.
    FixAudit(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

    int setmask() override;
    // Both see the velocity of the half step, (x(n+1) - x(n)) / dt: first with the forces
    // at x(n), then with those at x(n+1), so that their sum is the work over the step.
    void post_integrate() override;
    void post_force(int) override;

    // 1: of the nodes that are moved, the kinetic energy less the work done on them by
    // all forces but their drive [J]; 2: lost to the drag [J].
    double compute_vector(int i) override;

    // "work_share", "lost_share": this rank's shares of the sums over time.
    void* extract(const char* name, int& dimension) override;

    static LAMMPS_NS::Fix* create(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  private:
    bool moved(int atom_index) const;
    double power_on_moved_w() const;
    double kinetic_energy_j(bool of_moved) const;

    double rate_1_s_ = 0;
    int moved_bits_ = 0;
    double work_on_moved_j_ = 0;
    double lost_to_drag_j_ = 0;
};

}  // namespace magfsi::lammps
