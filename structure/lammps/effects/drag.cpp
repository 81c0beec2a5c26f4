// fix ID group magttice/drag RATE: every atom of the group is slowed at that rate,
// dv/dt = -RATE v. LAMMPS's fix viscous has one coefficient per atom type, but nodes
// differ in mass.
#include "atom.h"
#include "error.h"
#include "update.h"

#include <fmt/format.h>

#include <cmath>

#include "structure/lammps/effect.h"

namespace magfsi::structure {
namespace {

class FixMagtticeDrag : public LAMMPS_NS::Fix {
  public:
    FixMagtticeDrag(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
        : Fix(lammps, narg, arg) {
        if (narg != 4) {
            fail(*error,
                 fmt::format("fix {} magttice/drag takes one argument, the rate", id));
        }
        rate_1_s_ = number(arg[3], lmp);
        if (!(rate_1_s_ >= 0)) {
            fail(*error,
                 fmt::format("fix {} magttice/drag: the rate found is {}, it must "
                             "not be negative",
                             id, arg[3]));
        }
        dynamic_group_allow = 1;
    }
    int setmask() override {
        using namespace LAMMPS_NS::FixConst;
        return INITIAL_INTEGRATE | FINAL_INTEGRATE;
    }
    void init() override { reset_dt(); }
    void reset_dt() override {
        half_step_factor_ = std::exp(-0.5 * rate_1_s_ * update->dt);
    }
    void initial_integrate(int) override { slow_down(); }
    void final_integrate() override { slow_down(); }

  private:
    // The velocity decays exactly, at any rate and step, half a step at a time. As a
    // force it would need the velocity of the half step, which a restart from positions
    // and velocities does not have: the motion would not go on as it was.
    void slow_down() {
        double* const* const v = atom->v;
        for (int i = 0; i < atom->nlocal; ++i) {
            if ((atom->mask[i] & groupbit) == 0) continue;
            for (int d = 0; d < 3; ++d) v[i][d] *= half_step_factor_;
        }
    }

    double rate_1_s_ = 0;
    double half_step_factor_ = 1;  // exp(-rate dt / 2)
};

}  // namespace

extern const Effect drag_effect{
    .name = "drag",
    .asked = [](const LammpsInput& input) { return input.drag_rate_1_s.has_value(); },
    .commands =
        [](Lines& lines, const LammpsInput& input) {
            lines.push_back(
                fmt::format("fix drag all magttice/drag {:.17g}", *input.drag_rate_1_s));
        },
    .register_styles =
        [](LAMMPS_NS::LAMMPS& lammps) {
            add_fix_style<FixMagtticeDrag>(lammps, "magttice/drag");
        }};

}  // namespace magfsi::structure
