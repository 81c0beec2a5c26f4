// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/placement.h"

#include <cmath>

#include "structure/equilibrium/newton.h"
#include "structure/lattice/lattice.h"

namespace magfsi::structure {
namespace {

std::vector<double> node_volumes(const Body& body) {
    return build_lattice(body).node_volume_m3;
}

Vec3 centre_of_volume(const std::vector<Vec3>& nodes, const std::vector<double>& volume) {
    Vec3 sum{};
    double total = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
        total += volume[a];
        sum += volume[a] * nodes[a];
    }
    return sum / total;
}

void rotate(std::vector<Vec3>& nodes, const Vec3& centre, const std::array<int, 2>& plane,
            double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (Vec3& x : nodes) {
        const double first = x[plane[0]] - centre[plane[0]];
        const double second = x[plane[1]] - centre[plane[1]];
        x[plane[0]] = centre[plane[0]] + c * first - s * second;
        x[plane[1]] = centre[plane[1]] + s * first + c * second;
    }
}

}  // namespace

std::vector<Vec3> placed_nodes(const Body& body, const Placement& placement,
                               const std::array<int, 2>& field_plane) {
    std::vector<Vec3> nodes = body.mesh.nodes;
    if (placement.relaxed) {
        nodes = relaxed_shape(body, field_vector(*placement.relaxed, field_plane));
    }
    const PlaneRotation turn = placement.rotation.value_or(PlaneRotation{});
    if (turn.angle_rad == 0 && !placement.position_m) return nodes;
    const Vec3 centre = centre_of_volume(nodes, node_volumes(body));
    if (turn.angle_rad != 0) rotate(nodes, centre, turn.plane, turn.angle_rad);
    if (placement.position_m) {
        for (Vec3& x : nodes) x += *placement.position_m - centre;
    }
    return nodes;
}

}  // namespace magfsi::structure
