// How many steps of LAMMPS a coupled step of the participant has.
#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/participant.h"
#include "coupler/checkpoint/checkpoints.h"

namespace magfsi::lammps {

// Those of its last step: the deformation may have asked for more than the start.
void Participant::take_substeps_of_restart() {
    const auto& file = coupler::open_restart(session_);
    if (!file.has("substeps")) return;
    const auto kept = file.table("substeps");
    substeps_.count = std::max(substeps_.count, static_cast<int>(kept[0]));
    substeps_.lammps_step_s = substeps_.coupled_step_s / substeps_.count;
    counted_ = {static_cast<std::int64_t>(kept[1]), session_.clock().step(),
                static_cast<int>(kept[2]), static_cast<std::int64_t>(kept[1])};
}

double Participant::mean_substeps() const {
    const auto done =
        counted_.until(session_.clock().step(), substeps_.count) - counted_.at_start;
    return static_cast<double>(done) /
           static_cast<double>(std::max<std::int64_t>(1, session_.clock().steps_here()));
}

// What the run's LAMMPS steps came to.
void Participant::add_steps(output::StructureSummary& structure) const {
    structure.substeps_per_step = substeps_.count;
    structure.substeps = session_.clock().step() * substeps_.count;
    if (rest_) return;
    structure.substeps = counted_.until(session_.clock().step(), substeps_.count);
    if (counted_.fewest != substeps_.count)
        structure.fewest_substeps_per_step = counted_.fewest;
}

void Participant::add_step_guard() {
    tasks_.add("check stable step", [this] {
        if (session_.clock().step() % guard_->every() != 0) return;
        const auto verdict = guard_->look(engine_->gather(atoms_), substeps_);
        if (verdict.factor == 1) return;
        counted_.change(session_.clock().step(), substeps_.count);
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
