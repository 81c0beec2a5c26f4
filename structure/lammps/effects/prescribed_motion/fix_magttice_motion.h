// fix ID group magttice/motion COURSE: moves the atoms of its group, which no other fix
// may integrate, along a course (motion_law.h) from where they are at step 0.
//
// It keeps nothing: each step adds what the course gains in it, so that atoms may migrate
// and runs may go on from positions alone. (LAMMPS's fix move keeps every atom's start,
// refuses reset_timestep, and has no phase and no ramp.)
#pragma once

#include "fix.h"
#include "structure/lammps/effects/prescribed_motion/motion_law.h"

namespace magfsi::structure {

class FixMagtticeMotion : public LAMMPS_NS::Fix {
  public:
    FixMagtticeMotion(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override;
    void init() override;
    void initial_integrate(int) override;
    void final_integrate() override;

  private:
    double time_s(int steps_ago) const;
    void set_velocity(const Vec3& velocity_m_s);

    MotionCourse course_;
};

}  // namespace magfsi::structure
