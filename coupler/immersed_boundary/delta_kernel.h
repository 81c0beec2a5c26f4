// One-dimensional regularised delta functions phi(r), r in cells. Each has the partition
// of unity: sum over the cells of phi(x - i) = 1 for every x.
//   two_point    hat function
//   three_point  Roma, Peskin, Berger, J. Comput. Phys. 153 (1999)
//   four_point   Peskin, Acta Numerica 11 (2002), eq. (6.27)
#pragma once

#include <array>
#include <cmath>

namespace magfsi::coupler {

enum class Kernel { two_point = 2, three_point = 3, four_point = 4 };

constexpr int max_support = 4;

inline int support(Kernel kernel) {
    return static_cast<int>(kernel);
}

double delta(Kernel kernel, double r);

// The cells that a point touches along one axis: first, first + 1, ... with their
// weights. A cell i has its centre at i + 1/2.
struct Stencil1D {
    int first = 0;
    int count = 0;
    std::array<double, max_support> weight{};
};

// Without a call or a branch: every marker needs three of them a step.
inline int floor_of(double x) {
    const int toward_zero = static_cast<int>(x);
    return toward_zero - (x < toward_zero);
}

// All weights at once: by the kernels' own conditions (sum, first moment, even and odd
// cells) they follow from one root. Into its place, for a copy costs as much again.
inline void set_stencil(Stencil1D& s, Kernel kernel, double position_in_cells) {
    s.count = support(kernel);
    const double centred = position_in_cells - 0.5;  // cell i sits at i
    s.first = floor_of(centred - 0.5 * s.count) + 1;
    auto& w = s.weight;
    if (kernel == Kernel::two_point) {
        const double r = centred - s.first;
        w[0] = 1 - r;
        w[1] = r;
    } else if (kernel == Kernel::three_point) {
        const double r = centred - (s.first + 1);
        w[1] = (1 + std::sqrt(1 - 3 * r * r)) * (1.0 / 3);
        w[0] = 0.5 * (1 - w[1] - r);
        w[2] = 0.5 * (1 - w[1] + r);
    } else {
        const double r = centred - (s.first + 1);
        const double root = std::sqrt(1 + 4 * r * (1 - r));
        w[0] = 0.125 * (3 - 2 * r - root);
        w[1] = 0.125 * (3 - 2 * r + root);
        w[2] = 0.125 * (1 + 2 * r + root);
        w[3] = 0.125 * (1 + 2 * r - root);
    }
}

inline Stencil1D stencil_1d(Kernel kernel, double position_in_cells) {
    Stencil1D s;
    set_stencil(s, kernel, position_in_cells);
    return s;
}

}  // namespace magfsi::coupler
