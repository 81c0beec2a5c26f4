// All populations of a plane of cells, for a state that is kept and put back.
#pragma once

#include <span>

#include "fluid_lbm/sampling/macroscopic.h"

namespace magfsi::fluid {

// z: local index; values: [y][x][19] of the rank's cells, the populations that have
// arrived, as deviations from rest.
void read_plane(const View& view, int z, std::span<double> values);
void write_plane(const View& view, int z, std::span<const double> values);

}  // namespace magfsi::fluid
