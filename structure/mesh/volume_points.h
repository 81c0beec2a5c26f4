// Points spread through the volume of a body, carried by its elements: markers of an
// immersed boundary in bodies thicker than a grid cell.
#pragma once

#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct VolumePoint {
    MaterialPoint point;
    double volume_m3 = 0;  // the part of the body that it stands for, undeformed
};

// Cuts each element along its local axes into parts of at most `spacing_m` and puts a
// point into the middle of each. The volumes of an element's points add up to its own, by
// the midpoint rule, scaled. Throws std::invalid_argument for a spacing that is not
// positive.
std::vector<VolumePoint> volume_points(const Mesh& mesh, double spacing_m);

// Sum of the elements' volumes, undeformed [m3].
double volume_m3(const Mesh& mesh);

}  // namespace magfsi::structure
