// How many steps of LAMMPS a coupled step of the participant has.
#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/participant.h"
#include "coupler/checkpoint/open_restart.h"

namespace magfsi::lammps {

// Those of its last step: the deformation may have asked for more than the start.
void Participant::take_substeps_of_restart() {
    const auto& file = coupler::open_restart(session_);
    if (!file.has("substeps")) return;
    substeps_.count =
        std::max(substeps_.count, static_cast<int>(file.table("substeps")[0]));
    substeps_.lammps_step_s = substeps_.coupled_step_s / substeps_.count;
}

void Participant::add_step_guard() {
    tasks_.add("check stable step", [this] {
        if (session_.clock().step() % guard_->every() != 0) return;
        const auto verdict = guard_->look(engine_->gather(atoms_), substeps_);
        if (verdict.factor == 1) return;
        engine_->divide_step(verdict.factor);
        substeps_.count *= verdict.factor;
        substeps_.lammps_step_s /= verdict.factor;
        session_.log(
            fmt::format("step {}: the bodies' deformation has lowered their stable step "
                        "to {:.3g} us; "
                        "from here on {} steps of {:.3g} us in a coupled step",
                        session_.clock().step(), verdict.limit_s * 1e6, substeps_.count,
                        substeps_.lammps_step_s * 1e6));
    });
}

}  // namespace magfsi::lammps
