#include "coupler/immersed_boundary/markers.h"

namespace magfsi::coupler {

Vec3 at_marker(const Marker& marker, const double* nodal) {
    Vec3 value{};
    for (std::size_t a = 0; a < 8; ++a) {
        const double* v = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        for (std::size_t d = 0; d < 3; ++d) value[d] += marker.weight[a] * v[d];
    }
    return value;
}

void to_nodes(const Marker& marker, const Vec3& force, double* nodal) {
    for (std::size_t a = 0; a < 8; ++a) {
        double* f = nodal + 3 * static_cast<std::ptrdiff_t>(marker.node[a]);
        for (std::size_t d = 0; d < 3; ++d) f[d] += marker.weight[a] * force[d];
    }
}

}  // namespace magfsi::coupler
