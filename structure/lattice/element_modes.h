// An element's reference state in Hadamard mode space, as the fast kernel reads it.
#pragma once

#include <array>

#include "structure/lattice/element_energy.h"

namespace magfsi::structure {

// With x_a = sum_m h_m(a) u_m the force on mode n is -sum_m spring[nm] u_m; mode 0, the
// translation, drops out and a symmetric 7x7 remains, diagonal for bricks.
struct ElementModes {
    std::array<double, 28> spring{};    // G/8 H^T L H, upper triangle row by row [N/m]
    std::array<double, 21> gradient{};  // sum_a h_m(a) b_a / V0, three a mode [1/m]
    // hourglass.h: inverse metrics (11, 22, 12 of each group) [1/m2] and the reference
    // vectors X_j of the modes xy, xz, yz, xyz, three values a mode [m].
    std::array<double, 9> metric{};
    std::array<double, 12> offset{};
    double volume = 0;   // [m3]
    bool brick = false;  // spring is diagonal, gradient that of a brick
};

ElementModes element_modes(const ElementReference& reference, double shear_modulus_pa);

// Positions of the seven diagonal entries within ElementModes::spring.
inline constexpr std::array<int, 7> diagonal_entries{0, 7, 13, 18, 22, 25, 27};

// Positions within ElementModes::metric of the inverse squares of a brick's half edges
// along x, y, z.
inline constexpr std::array<int, 3> brick_metric_entries{3, 0, 1};

}  // namespace magfsi::structure
