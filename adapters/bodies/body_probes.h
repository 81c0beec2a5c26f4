// The bodies' columns of probes.csv, from the nodes as they are.
#pragma once

#include <optional>
#include <vector>

#include "adapters/bodies/nodal_state.h"
#include "adapters/scene/scene.h"
#include "structure/mesh/mesh.h"

namespace magfsi::bodies {

// The nodes of one body within the nodal state, and what its probes refer to.
struct BodyNodes {
    std::size_t first = 0;  // index of the body's node 0
    std::size_t count = 0;
    std::vector<structure::MaterialPoint> centre_line;
    std::vector<Vec3> start_m;  // positions at step 0
};

Vec3 position(const structure::MaterialPoint& point, const NodalState& state,
              std::size_t first_node);

Vec3 centre_of_mass(const BodyNodes& body, const NodalState& state);
Vec3 mean_velocity(const BodyNodes& body, const NodalState& state);
double kinetic_energy_j(const BodyNodes& body, const NodalState& state);
double max_displacement_m(const BodyNodes& body, const NodalState& state);

// Shape of the centre line. mid_rise: height of the middle over the straight line between
// the ends, along the middle's normal (positive: C, ends down; negative: V). bend: angle
// of the right end's tangent against the left end's, in the x-z plane (positive: ends
// up).
struct Shape {
    double end_to_end_m = 0;
    double mid_rise_m = 0;
    double bend_rad = 0;
};
Shape shape(const BodyNodes& body, const NodalState& state);

}  // namespace magfsi::bodies
