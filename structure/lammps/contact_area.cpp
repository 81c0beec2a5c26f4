#include "structure/lammps/contact_area.h"

#include <cmath>

#include "structure/mesh/surface.h"

namespace magfsi::structure {

std::vector<double> contact_areas(const std::vector<Vec3>& nodes_m,
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

}  // namespace magfsi::structure
