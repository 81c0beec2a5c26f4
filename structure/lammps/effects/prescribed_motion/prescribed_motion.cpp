// SPDX-License-Identifier: GPL-2.0-or-later
// Prescribed motion: fix ID group magttice/motion COURSE moves the atoms of its group
// along a course (motion_law.h), starting from their places at step 0. No other fix may
// integrate these atoms.
//
// The fix has no state: each step adds the gain of the course in that step (of a turn,
// that of the angle), so that atoms may migrate and runs may continue from positions
// alone. (LAMMPS's fix move stores every atom's start, refuses reset_timestep, and has no
// phase and no ramp.)
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "structure/lammps/effect.h"
#include "structure/lammps/motion_law.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {
namespace {

class FixMagtticeMotion : public LAMMPS_NS::Fix {
  public:
    FixMagtticeMotion(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override;
    void init() override;
    void initial_integrate(int) override;
    void final_integrate() override;

  private:
    // Displacement, velocity or turn of the course at the present step, or some steps
    // ago.
    template <class Value>
    Value of_course(Value (*what)(const MotionCourse&, double time_s),
                    int steps_ago) const;
    // Sets the velocity of all atoms in the group to that of the course.
    void set_velocity();
    // Place of an atom without the jumps at periodic sides.
    Vec3 place_m(int i) const;

    MotionCourse course_;
};

FixMagtticeMotion::FixMagtticeMotion(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    try {
        course_ = motion_from({arg + 3, arg + narg});
    } catch (const std::invalid_argument& fault) {
        fail(*error, "fix {} magttice/motion: {}", id, fault.what());
    }
    dynamic_group_allow = 1;
}

int FixMagtticeMotion::setmask() {
    return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::FINAL_INTEGRATE;
}

// The time is derived from the step number, so that it is the same after a restart.
template <class Value>
Value FixMagtticeMotion::of_course(Value (*what)(const MotionCourse&, double time_s),
                                   int steps_ago) const {
    try {
        return what(course_,
                    static_cast<double>(update->ntimestep - steps_ago) * update->dt);
    } catch (const std::exception& cause) {
        fail(*error, "fix {} magttice/motion: {}", id, cause.what());
    }
}

// Velocities are set before the first forces are evaluated and before ghosts get theirs.
void FixMagtticeMotion::init() {
    refuse_integrated_twice(*lmp, *this);
    set_velocity();
}

// Forces see the mean velocity of the step, as they do for the atoms that velocity Verlet
// has moved by half a step.
void FixMagtticeMotion::initial_integrate(int) {
    const Vec3 shift = of_course(displacement_m, 0) - of_course(displacement_m, 1);
    const Turn before = of_course(turn_rad, 1);
    const Vec3 turn = of_course(turn_rad, 0).vector - before.vector;
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) == 0) continue;
        const Vec3 gain = shift + turned_by_m(turn, place_m(i) - before.about_m);
        add_to(atom->x[i], gain);
        const Vec3 mean = gain / update->dt;
        std::copy_n(mean.data(), 3, atom->v[i]);
    }
}

void FixMagtticeMotion::final_integrate() {
    set_velocity();
}

void FixMagtticeMotion::set_velocity() {
    const Vec3 linear = of_course(velocity_m_s, 0);
    const Turn rate = of_course(turn_rate_rad_s, 0);
    for (int i = 0; i < atom->nlocal; ++i) {
        if ((atom->mask[i] & groupbit) == 0) continue;
        const Vec3 velocity = linear + cross(rate.vector, place_m(i) - rate.about_m);
        std::copy_n(velocity.data(), 3, atom->v[i]);
    }
}

Vec3 FixMagtticeMotion::place_m(int i) const {
    Vec3 place{};
    domain->unmap(atom->x[i], atom->image[i], place.data());
    return place;
}

std::vector<int> moved_ids(const LammpsInput& input, const PrescribedMotion& motion) {
    std::vector<int> ids = moved_nodes(input.bodies[motion.body], motion);
    const int first = first_id(input, motion.body);
    for (int& id : ids) id += first;
    return ids;
}

// Motions come after the drag in the script, which would slow these nodes down.
void add_motions(Lines& lines, const LammpsInput& input) {
    for (std::size_t m = 0; m < input.motions.size(); ++m) {
        const std::string group = moved_group(m);
        lines.push_back(fmt::format("group {} id {}", group,
                                    id_ranges(moved_ids(input, input.motions[m]))));
        lines.push_back(fmt::format("fix {0} {0} magttice/motion {1}", group,
                                    motion_words(input.motions[m].course)));
    }
}

}  // namespace

extern const Effect prescribed_motion_effect{
    .name = "prescribed_motion",
    .asked = [](const LammpsInput& input) { return !input.motions.empty(); },
    .check = [](const LammpsInput& input) { check_motions(input.bodies, input.motions); },
    .after_integration = add_motions,
    .fix = {"magttice/motion", make_fix<FixMagtticeMotion>}};

}  // namespace magfsi::structure
