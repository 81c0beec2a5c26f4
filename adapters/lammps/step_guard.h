// Keeps LAMMPS's steps below the limit of the bodies as they are deformed: where it
// falls, a coupled step gets more of them.
#pragma once

#include <mpi.h>

#include <vector>

#include "adapters/bodies/nodal_state.h"
#include "adapters/lammps/substeps.h"
#include "structure/body.h"
#include "structure/lattice/stable_step.h"

namespace magfsi::lammps {

class StepGuard {
  public:
    // bodies: with the inertia that their nodes have. Only the root (comm's rank 0)
    // holds their elements.
    StepGuard(const std::vector<structure::Body>& bodies, const Substeps& substeps,
              MPI_Comm comm);

    // A look costs about as much as a LAMMPS step: one in this many coupled steps.
    std::int64_t every() const { return every_; }

    struct Verdict {
        int factor = 1;  // more steps than now
        double limit_s = 0;
    };
    // state: on the root. Collective. Throws coupler::Diverged where more than 16 times
    // the steps of the start would be needed.
    Verdict look(const bodies::NodalState& state, const Substeps& now) const;

  private:
    MPI_Comm comm_;
    Substeps start_;
    std::int64_t every_ = 1;
    std::vector<structure::CurrentStep> elements_;
    std::vector<std::size_t> first_node_;
};

}  // namespace magfsi::lammps
