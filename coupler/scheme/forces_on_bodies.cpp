// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of the fluid on bodies and on parts of them, for probes: sums over their
// markers.
#include "coupler/scheme/structure_coupling.h"

namespace magfsi::coupler {

namespace {

// Adds vectors over the ranks, with the result on all of them. Collective.
std::vector<Vec3> over_ranks(std::vector<Vec3> sum, MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3 * sum.size(), MPI_DOUBLE, MPI_SUM, comm);
    return sum;
}

}  // namespace

// Force of the fluid on the body at a marker [N]: the reaction to its impulses, the force
// of the enclosed fluid, and the inertia and weight of the fluid whose mass was taken off
// the nodes.
Vec3 StructureCoupling::force_on(std::size_t marker) const {
    const double step_s = step_.duration_s;
    const Vec3 velocity = at_marker(force_->markers()[marker], solver_.velocities());
    const Vec3 acceleration =
        (velocity - start_velocity_[marker]) / step_s - markers_.gravity_m_s2;
    return force_->enclosed().force()[marker] +
           (markers_.off_nodes_kg[marker] * acceleration -
            force_->impulse()[marker] / step_s);
}

std::vector<Vec3> StructureCoupling::force_on_bodies() {
    solver_.renew_ghost_velocities();
    std::vector<Vec3> sum(markers_.bodies);
    for (std::size_t m = 0; m < force_->markers().size(); ++m)
        sum[force_->markers()[m].body] += force_on(m);
    return over_ranks(std::move(sum), session_.world().local());
}

std::vector<Vec3> StructureCoupling::torque_on_bodies() {
    solver_.renew_ghost_velocities();
    std::vector<Vec3> sum(markers_.bodies);
    for (std::size_t m = 0; m < force_->markers().size(); ++m) {
        const Marker& marker = force_->markers()[m];
        const Vec3 f = force_on(m), x = at_marker(marker, solver_.positions());
        sum[marker.body] += cross(x, f);
    }
    return over_ranks(std::move(sum), session_.world().local());
}

std::vector<Vec3> StructureCoupling::force_on_parts() {
    solver_.renew_ghost_velocities();
    std::vector<Vec3> sum(markers_.parts.size());
    for (std::size_t p = 0; p < sum.size(); ++p) {
        for (const std::size_t m : markers_.parts[p]) sum[p] += force_on(m);
    }
    return over_ranks(std::move(sum), session_.world().local());
}

}  // namespace magfsi::coupler
