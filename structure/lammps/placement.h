// Where a body starts: its relaxed shape, turned and moved.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/field_program.h"

namespace magfsi::structure {

struct Placement {
    std::optional<ConstantField> relaxed;  // shape at rest in this field, no other load
    std::array<int, 2> rotation_plane{0, 2};  // from the first axis towards the second
    double rotation_rad = 0;                  // about the centre of volume
    std::optional<Vec3> position_m;           // of the centre of volume
};

// Node positions after relaxing, rotating and moving, in this order. The centre of volume
// is taken with the nodes' volumes at rest, as masses are. Throws as NewtonSolver
// does.
std::vector<Vec3> placed_nodes(const Body& body, const Placement& placement,
                               const std::array<int, 2>& field_plane);

}  // namespace magfsi::structure
