#include "coupler/immersed_boundary/delta_kernel.h"

#include <algorithm>
#include <cmath>

namespace magfsi::coupler {

namespace {

double three_point(double r) {
    if (r <= 0.5) return (1 + std::sqrt(1 - 3 * r * r)) / 3;
    if (r < 1.5) {
        const double root = std::sqrt(std::max(0.0, 1 - 3 * (1 - r) * (1 - r)));
        return (5 - 3 * r - root) / 6;
    }
    return 0;
}

double four_point(double r) {
    if (r < 1) return (3 - 2 * r + std::sqrt(1 + 4 * r - 4 * r * r)) / 8;
    if (r < 2) return (5 - 2 * r - std::sqrt(std::max(0.0, -7 + 12 * r - 4 * r * r))) / 8;
    return 0;
}

}  // namespace

double delta(Kernel kernel, double r) {
    const double distance = std::abs(r);
    switch (kernel) {
        case Kernel::two_point:
            return std::max(0.0, 1 - distance);
        case Kernel::three_point:
            return three_point(distance);
        case Kernel::four_point:
            return four_point(distance);
    }
    return 0;
}

}  // namespace magfsi::coupler
