// What the fluid participant will need of memory beside its program and libraries.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "adapters/scene/scene.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

struct FluidMemory {
    double populations = 0;  // bytes, all ranks
    // Of effects that the scene names: held for the whole run, and for moments one after
    // the other, of which the largest counts.
    std::vector<std::pair<std::string, double>> held, passing;

    double peak() const;
};

// From the sizes that the solver will allocate; markers_m: where they are at the start.
// What bodies touch depends on their motion: it is that of a sheet that is a little bent.
FluidMemory fluid_memory(const scene::Scene& scene, int ranks,
                         std::span<const fluid::Vec3> markers_m = {});

}  // namespace magfsi::lbm
