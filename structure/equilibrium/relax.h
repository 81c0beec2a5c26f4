// Static shape of a magnetic body in a constant uniform field, without other loads.
#pragma once

#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

struct RelaxedBody {
    std::vector<Vec3> nodes_m;
    int steps = 0;
    double residual = 0;  // largest nodal force over the largest magnetic nodal force
};

// Released at rest from the body's own shape and slowed down by the FIRE scheme (Bitzek
// et al., Phys. Rev. Lett. 97, 170201, 2006), until the residual is below 1e-6. As with a
// real release the start chooses among several equilibria; an exactly balanced unstable
// one is kept. Clamped faces stay; a free body's centre of mass does. Throws
// std::runtime_error, naming the body, if an element inverts or no equilibrium is found.
RelaxedBody relax(const Body& body, const Vec3& field_t);

}  // namespace magfsi::structure
