#include "adapters/lammps/step_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "coupler/participants/errors.h"

namespace magfsi::lammps {

namespace {

// Sound crosses an element in about one step, and deformations that change its stiffness
// take many crossings.
constexpr std::int64_t steps_between_looks = 100;
// The step is chosen at 0.9 of the limit at rest; moderate strains stay below this.
constexpr double allowed = 0.95;
constexpr double chosen = 0.9;
constexpr int most_refinement = 16;

}  // namespace

StepGuard::StepGuard(const std::vector<structure::Body>& bodies, const Substeps& substeps,
                     MPI_Comm comm)
    : comm_(comm),
      start_(substeps),
      every_(std::max<std::int64_t>(1, steps_between_looks / substeps.count)) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    std::size_t first = 0;
    for (const structure::Body& body : bodies) {
        first_node_.push_back(first);
        first += body.mesh.nodes.size();
        if (rank == 0) elements_.emplace_back(body);
    }
    first_node_.push_back(first);
}

StepGuard::Verdict StepGuard::look(const bodies::NodalState& state,
                                   const Substeps& now) const {
    double rise = 0;
    const std::span<const bodies::Vec3> nodes(state.position_m);
    for (std::size_t b = 0; b < elements_.size(); ++b) {
        const std::size_t first = first_node_[b];
        rise = std::max(rise, elements_[b].rise_1_s2(
                                  nodes.subspan(first, first_node_[b + 1] - first)));
    }
    MPI_Bcast(&rise, 1, MPI_DOUBLE, 0, comm_);
    Verdict verdict;
    // An inverted element ends the run in LAMMPS, which names it.
    if (!std::isfinite(rise)) return verdict;
    verdict.limit_s = structure::CurrentStep::step_s(start_.elastic_limit_s, rise);
    // A step that the scene asks for may be nearer to the limit from the start.
    const double part = std::max(allowed, start_.lammps_step_s / start_.elastic_limit_s);
    if (rise == 0 || now.lammps_step_s <= part * verdict.limit_s) return verdict;
    verdict.factor =
        static_cast<int>(std::ceil(now.lammps_step_s / (chosen * verdict.limit_s)));
    if (now.count * verdict.factor <= most_refinement * start_.count) return verdict;
    throw coupler::Diverged(fmt::format(
        "the bodies are so deformed that their stable step has fallen from {:.3g} to "
        "{:.3g} us, which needs more than {} times the steps; use a finer mesh or a "
        "weaker field",
        start_.elastic_limit_s * 1e6, verdict.limit_s * 1e6, most_refinement));
}

}  // namespace magfsi::lammps
