#include "structure/mesh/orientation.h"

#include <algorithm>
#include <array>

#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {
namespace {

// New local axis d is the old axis `axis[d]`, turned round where bit d of `flips` is set.
Hexahedron renumbered(const Hexahedron& element, const std::array<int, 3>& axis,
                      int flips) {
    Hexahedron out{};
    for (int a = 0; a < 8; ++a) {
        int old = 0;
        for (int d = 0; d < 3; ++d) old |= (((a ^ flips) >> d) & 1) << axis[d];
        out[a] = element[old];
    }
    return out;
}

}  // namespace

Hexahedron lexicographic(const Hexahedron& round) {
    return {round[0], round[1], round[3], round[2],
            round[4], round[5], round[7], round[6]};
}

Hexahedron oriented(const std::vector<Vec3>& nodes_m, const Hexahedron& element) {
    const Eigen::Matrix3d old_axes =
        gather(nodes_m, element).transpose() * shape_gradients({0, 0, 0});
    Hexahedron best = element;
    double closest = -4;  // below the least sum of three cosines
    std::array<int, 3> axis{0, 1, 2};
    do {
        for (int flips = 0; flips < 8; ++flips) {
            Eigen::Matrix3d axes;
            for (int d = 0; d < 3; ++d) {
                axes.col(d) = (((flips >> d) & 1) != 0 ? -1 : 1) *
                              old_axes.col(axis[d]).stableNormalized();
            }
            if (!(axes.determinant() > 0) || axes.trace() <= closest) continue;
            closest = axes.trace();
            best = renumbered(element, axis, flips);
        }
    } while (std::next_permutation(axis.begin(), axis.end()));
    return best;
}

}  // namespace magfsi::structure
