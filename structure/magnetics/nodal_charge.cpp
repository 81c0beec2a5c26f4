#include "structure/magnetics/nodal_charge.h"

#include <fmt/format.h>

#include <stdexcept>

namespace magfsi::structure {

std::vector<double> nodal_charges(const std::vector<Vec3>& nodes_m,
                                  const std::vector<Hexahedron>& elements,
                                  const std::vector<Vec3>& magnetization_a_m) {
    std::vector<double> charges(nodes_m.size(), 0.0);
    if (magnetization_a_m.empty()) return charges;
    if (magnetization_a_m.size() != elements.size()) {
        throw std::invalid_argument(fmt::format(
            "{} magnetisation vectors for {} elements found, one an element or "
            "none is allowed",
            magnetization_a_m.size(), elements.size()));
    }
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const Eigen::Vector3d m(magnetization_a_m[e][0], magnetization_a_m[e][1],
                                magnetization_a_m[e][2]);
        const HexahedronIntegrals integrals =
            integrate_hexahedron(gather(nodes_m, elements[e]), static_cast<int>(e));
        for (int a = 0; a < 8; ++a) {
            charges[elements[e][a]] += integrals.gradient.row(a).dot(m);
        }
    }
    return charges;
}

}  // namespace magfsi::structure
