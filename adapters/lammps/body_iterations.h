// What BodyCoupling has more of in an implicit scheme.
#pragma once

#include "adapters/lammps/body_coupling.h"
#include "coupler/scheme/fixed_point.h"

namespace magfsi::lammps {

struct BodyCoupling::Iterations {
    coupler::FixedPoint fixed_point;
    bool linear;  // over the substeps
    // At the start of the step:
    Engine::Snapshot bodies;
    coupler::EnclosedFluid enclosed;
    std::vector<Vec3> markers_m;
    std::vector<Vec3> answer;
    coupler::MarkerWork work;  // at the start of the step; of an energy audit
};

}  // namespace magfsi::lammps
