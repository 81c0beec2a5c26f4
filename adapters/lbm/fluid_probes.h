// The fluid's columns of probes.csv.
#pragma once

#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "fluid_lbm/fluid.h"

namespace magfsi::lbm {

// In the order of scene::fluid_columns. Collective.
std::vector<double> probe_values(const scene::Scene& scene, const fluid::Fluid& fluid);

// Axes of drag and lift. The flow's: along which an inlet (the first one), a body force
// or an initial velocity is largest; x without any. Lift's: of the two others the one
// whose sides are not periodic, and of two alike the one that comes first in the order z,
// y, x.
struct ForceAxes {
    std::size_t drag = 0, lift = 2;
};
ForceAxes force_axes(const scene::Fluid& fluid);

}  // namespace magfsi::lbm
