#include "coupler/immersed_boundary/penalty_kernel.h"

namespace magfsi::coupler {

void pull_nodes(const MarkerPull& pull, const double* nodal_velocity, double duration_s,
                double* nodal_force, std::span<Vec3> impulse) {
    for (std::size_t m = 0; m < pull.markers.size(); ++m) {
        const Vec3 velocity = at_marker(pull.markers[m], nodal_velocity);
        Vec3 force = pull.constant[m];
        for (std::size_t d = 0; d < 3; ++d) {
            const double given =
                pull.kappa[m] * (velocity[d] - pull.fluid_velocity[m][d]);
            impulse[m][d] += given * duration_s;
            force[d] -= given;
        }
        to_nodes(pull.markers[m], force, nodal_force);
    }
}

}  // namespace magfsi::coupler
