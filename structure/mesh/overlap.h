// Bodies that fill the same space.
#pragma once

#include <optional>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct Overlap {
    Vec3 at_m{};         // a point of one body inside the other
    double depth_m = 0;  // its distance to the other's surface
    int of_body = 0;     // 0: a point of a in b; 1: of b in a
    int in_element = -1;
};

// Whether two bodies, with their nodes where they are placed, fill the same space: their
// bounding boxes first, then nodes, element centres and points of the surface of each,
// half the other's shortest edge apart, in the elements of the other. Bodies that only
// touch, to a millionth of an element, do not overlap. Penetration less deep
// than a quarter of the shortest edge may be missed at corners and edges.
std::optional<Overlap> bodies_overlap(const Mesh& a, const Mesh& b);

}  // namespace magfsi::structure
