#include "adapters/bodies/body_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "structure/lattice/hexahedron.h"

namespace magfsi::bodies {

namespace {

bool holds(const std::array<scene::Vec3, 2>& box_m, const structure::Vec3& x) {
    for (std::size_t d = 0; d < 3; ++d) {
        if (x[d] < box_m[0][d] || x[d] > box_m[1][d]) return false;
    }
    return true;
}

structure::Vec3 centre(const structure::Mesh& mesh,
                       const structure::Hexahedron& element) {
    structure::Vec3 sum{};
    for (const int node : element) {
        for (std::size_t d = 0; d < 3; ++d)
            sum[d] += mesh.nodes[static_cast<std::size_t>(node)][d] / 8;
    }
    return sum;
}

}  // namespace

std::vector<bool> elements_of(const scene::BodyPart& part, const structure::Mesh& mesh) {
    std::vector<bool> in(mesh.elements.size(), !part.box_m);
    if (!part.box_m) return in;
    for (std::size_t e = 0; e < in.size(); ++e)
        in[e] = holds(*part.box_m, centre(mesh, mesh.elements[e]));
    if (std::ranges::find(in, true) == in.end())
        throw std::invalid_argument(fmt::format(
            "probes.integrals: no element of body '{}' has its centre in the box",
            part.body));
    return in;
}

std::vector<double> node_shares(const std::vector<bool>& elements,
                                const structure::Mesh& mesh) {
    std::vector<double> mine(mesh.nodes.size()), all(mine);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const auto x = structure::gather(mesh.nodes, mesh.elements[e]);
        const double volume =
            structure::integrate_hexahedron(x, static_cast<int>(e)).volume;
        for (const int node : mesh.elements[e]) {
            const auto n = static_cast<std::size_t>(node);
            all[n] += volume;
            if (elements[e]) mine[n] += volume;
        }
    }
    for (std::size_t n = 0; n < mine.size(); ++n)
        mine[n] = all[n] > 0 ? mine[n] / all[n] : 0;
    return mine;
}

}  // namespace magfsi::bodies
