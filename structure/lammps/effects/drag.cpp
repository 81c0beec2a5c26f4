// SPDX-License-Identifier: GPL-2.0-or-later
// Drag by fix ID group magttice/drag RATE: the velocity of every atom in the group decays
// by drag_law.h. LAMMPS's fix viscous has one coefficient per atom type, whereas nodes
// differ in mass.
#include "atom.h"
#include "error.h"
#include "update.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "structure/lammps/effect.h"

namespace magfsi::structure {
namespace {

// Drag as a factor on velocities, before and after each integration step.
class FixMagtticeDrag : public LAMMPS_NS::Fix {
  public:
    FixMagtticeDrag(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
        : Fix(lammps, narg, arg) {
        DragNumbers numbers{};
        const bool complete = narg == 3 + static_cast<int>(numbers.size());
        for (std::size_t i = 0; complete && i < numbers.size(); ++i)
            numbers[i] = number(arg[3 + i], lmp);
        const auto allowed = [](double value) { return value >= 0; };
        if (!complete || !std::ranges::all_of(numbers, allowed)) {
            fail(*error,
                 "fix {} magttice/drag with \"{}\" found; it takes the rate, which must "
                 "not be negative",
                 id, fmt::join(arg + 3, arg + narg, " "));
        }
        drag_ = std::bit_cast<Drag>(numbers);
        dynamic_group_allow = 1;
    }
    int setmask() override {
        using namespace LAMMPS_NS::FixConst;
        return INITIAL_INTEGRATE | FINAL_INTEGRATE;
    }
    void init() override { reset_dt(); }
    void reset_dt() override { half_step_ = DragDecay(drag_, 0.5 * update->dt); }
    void initial_integrate(int) override { slow_down(); }
    void final_integrate() override { slow_down(); }

  private:
    // The velocity decays exactly, for any rate and step, by half a step at a time. As a
    // force, drag would need the velocity of the half step, which a restart from
    // positions and velocities does not have, so that the motion would not continue
    // unchanged.
    void slow_down() {
        double* const* const v = atom->v;
        for (int i = 0; i < atom->nlocal; ++i) {
            if ((atom->mask[i] & groupbit) == 0) continue;
            const double left = half_step_.share(v[i]);
            for (int d = 0; d < 3; ++d) v[i][d] *= left;
        }
    }

    Drag drag_;
    DragDecay half_step_;
};

}  // namespace

extern const Effect drag_effect{
    .name = "drag",
    .asked = [](const LammpsInput& input) { return input.drag.has_value(); },
    .commands =
        [](Lines& lines, const LammpsInput& input) {
            lines.push_back(
                fmt::format("fix drag all magttice/drag {:.17g}",
                            fmt::join(std::bit_cast<DragNumbers>(*input.drag), " ")));
        },
    .fix = {"magttice/drag", make_fix<FixMagtticeDrag>}};

}  // namespace magfsi::structure
