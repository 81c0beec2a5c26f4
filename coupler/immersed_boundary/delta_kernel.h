// One-dimensional regularised delta functions phi(r), r in cells. Each has the partition
// of unity: sum over the cells of phi(x - i) = 1 for every x.
//   two_point    hat function
//   three_point  Roma, Peskin, Berger, J. Comput. Phys. 153 (1999)
//   four_point   Peskin, Acta Numerica 11 (2002), eq. (6.27)
#pragma once

#include <array>

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

Stencil1D stencil_1d(Kernel kernel, double position_in_cells);

}  // namespace magfsi::coupler
