// What can be asked of platform and contact; the effects of these names act on it.
#pragma once

#include "structure/body.h"

namespace magfsi::structure {

struct Platform {
    Vec3 point_m{};
    Vec3 normal{0, 0, 1};       // unit vector, towards the bodies
    double stiffness_pa_m = 0;  // pressure over penetration
    double friction = 0;        // Coulomb's coefficient mu; 0: smooth
    double damping_pa_s_m = 0;  // pressure over the speed of approach, while touching
};

struct ContactLaw {
    double distance_m = 0;      // d: nodes closer than this repel
    double stiffness_pa_m = 0;  // s: pressure over approach
    // Nodes of one body whose distance at rest is below this many d do not repel.
    double excluded = 2;
};

}  // namespace magfsi::structure
