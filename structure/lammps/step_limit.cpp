#include "structure/lammps/step_limit.h"

#include <algorithm>
#include <cmath>

#include "structure/lattice/lattice.h"
#include "structure/lattice/stable_step.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

std::vector<double> surface_areas(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements) {
    Mesh mesh;
    mesh.nodes = nodes_m;
    mesh.elements = elements;
    std::vector<Vec3> share(nodes_m.size(), Vec3{});
    for (const SurfaceQuad& quad : boundary_quads(mesh)) {
        const Vec3 area = quad_area_vector(corners(nodes_m, quad.node));
        for (int node : quad.node) {
            for (std::size_t d = 0; d < 3; ++d) {
                share[static_cast<std::size_t>(node)][d] += 0.25 * area[d];
            }
        }
    }
    std::vector<double> out;
    out.reserve(share.size());
    for (const Vec3& v : share) out.push_back(std::hypot(v[0], v[1], v[2]));
    return out;
}

double step_limit_s(const Body& body, double stiffness_pa_m) {
    const double own = stable_step_s(body);
    const double frequency = 2 / stable_elastic_step_s(body);
    // From the definition of the body's own step.
    const double damping = 2 / own - 0.5 * own * frequency * frequency;
    const auto area = surface_areas(body.mesh.nodes, body.mesh.elements);
    const auto mass = build_lattice(body).node_mass_kg;
    double largest = 0;
    for (std::size_t a = 0; a < area.size(); ++a) {
        largest = std::max(largest, stiffness_pa_m * area[a] / mass[a]);
    }
    const double squared = frequency * frequency + largest;
    return 4 / (std::sqrt(damping * damping + 4 * squared) + damping);
}

}  // namespace magfsi::structure
